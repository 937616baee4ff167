// dgf: root systems in Dune's grid format, which DuMux, CPlantBox and CRootBox write.
#include "espalier/language/notation.h"

#include "language/dgf/plants.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"dgf", ".dgf", "root systems of DuMux, CPlantBox and CRootBox (Dune's grid format)",
     R"(Vertices, and a row for each segment between two of them. They become the axiom of a model: as it is, or growing if the segments
have times.

    DGF
    Vertex
    0 0 0
    0 0 -0.2
    #
    Simplex
    parameters 5 # order, branch, surface [cm2], radius [cm], emergence [d]
    0 1  0 1 1.2566 0.01 3
    #

order      none; of branching. Segments of order -1 are no roots and are left out
branch     none; the axis that a segment belongs to. Without it, an axis goes on with the segment of the same order, or else the thickest
surface    none; in cm2: with the radius it tells the unit of the coordinates, which is m or cm
length     none; in cm: tells the unit where there are no surfaces
radius     0.025 cm; of a segment
emergence  none; the day on which a segment appears

Other columns are named by a warning. Columns without names stand in the order order, branch, surface, length, radius, kz, kr, emergence,
subtype, organ type. A row may have the child first, and children may stand before their parents. The third coordinate points upwards;
`espalier import` with --unit and --up overrules that. --define DT=0.5 sets the days of a step.
The format: A. Dedner et al., the DGF parser of Dune-Grid. Its use for roots: T. Koch et al.: DuMux 3. Computers & Mathematics with
Applications 81, 2021.)",
     nullptr, [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return dgf::read(std::move(text), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
