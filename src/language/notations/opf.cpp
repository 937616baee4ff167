// opf: plants in the Open Plant Format of the AMAP programs.
#include "espalier/language/notation.h"

#include "language/opf/axes.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"opf", ".opf", "plants of the AMAP programs (Open Plant Format)",
     R"(The pieces of a plant's axes become the axiom of a model: entities whose mesh is as thick one way as the other and runs along
its x axis, as those of internodes. A matrix, three rows of four numbers, puts the mesh to its place; dDwn and dUp, whose mean is
drawn, multiply it across where it has enableScale. <follow> goes on, <branch> is borne by what it stands in, and the parts of
<decomp> stand on what their whole stands on. Each entity of the coarsest scale above 0 is a plant of its own.

Leaves and other organs, whose meshes are no such pieces, are drawn as polygons, a flat mesh as one; they stand on the piece that bears
them. Materials are not used.

Lengths are cm, and z points upwards. Attributes are not used: a warning names each.
S. Griffon, F. de Coligny: AMAPstudio, an editing and simulation software suite for plants architecture modelling. Ecological
Modelling 290, 2014.)",
     nullptr, [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return opf::read_plants(std::move(text), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
