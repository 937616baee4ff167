// ops: scenes of plants in the Open Plant Format.
#include "espalier/language/notation.h"

#include "language/opf/axes.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"ops", ".ops", "scenes of plants of the AMAP programs, which name .opf files",
     R"(Each row puts a plant of an .opf file, whose name is relative to the scene's, to its place.

  row        scene plant file x y z scale azimuth angle twist: numbers of the scene and the plant; the file; its place, m; how many
             times as large it is; the direction in which it leans, and by how much, and its turn about its stem, radians
  terrain    a row that begins with T, which is not used
  comment    a row that begins with #

The plants are read as `espalier list opf` says.
S. Griffon, F. de Coligny: AMAPstudio, an editing and simulation software suite for plants architecture modelling. Ecological
Modelling 290, 2014.)",
     nullptr, [](const std::string& text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return opf::read_scene(text, path, options);
     }}};

}  // namespace
}  // namespace espalier::language
