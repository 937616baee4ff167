// mtg: measured plants as multiscale tree graphs (Godin & Caraglio 1998), the files of AMAPmod and OpenAlea.
#include "espalier/language/notation.h"

#include "language/mtg/axes.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"mtg", ".mtg", "measured plants (multiscale tree graphs, Godin & Caraglio 1998)",
     R"(The axes of a plant whose entities have coordinates become the axiom of a model: as they are, or growing if the
entities have a birth. The finest scale with coordinates counts; < follows, + is borne by. Entities without coordinates lie evenly
between their neighbours; those beyond the last one of an axis are left out.

  XX, YY, ZZ      coordinates of the end of an entity, or X, Y, Z; z points upwards
  diameter        of it, or diam, dia, TopDiameter, TopDia; without it that of the entity before, at first 5 mm
  length          of the first entity of a trunk, which tells where that begins
  birth           the day on which it appears
  # unit: cm      a line that says the unit: m (as without it), cm or mm
  # up: y         a line that says what points upwards: z (as without it) or y

--define DT=0.5 sets the days of a step. Each axis ends with a module Tip(order), where a model made by `espalier translate` can go on
to grow. Rows of entities (<< and <.) are not read.
C. Godin, Y. Caraglio: A multiscale model of plant topological structures. Journal of Theoretical Biology 191, 1998.)",
     nullptr, [](const std::string& text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return mtg::axes_of(mtg::read(text, path.string()), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
