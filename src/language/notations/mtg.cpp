// mtg: measured plants as multiscale tree graphs (Godin & Caraglio 1998), the files of AMAPmod and OpenAlea.
#include "espalier/language/notation.h"

#include "language/mtg/axes.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"mtg", ".mtg", "measured plants (multiscale tree graphs, Godin & Caraglio 1998)",
     R"(The axes of a plant whose entities have coordinates become the axiom of a model: as they are, or growing if the
entities have dates. The finest scale with coordinates counts; < follows, + is borne by. Entities without coordinates lie evenly
between their neighbours; those beyond the last one of an axis are left out, with a warning. Each entity of the coarsest scale
above 0 is a plant of its own.

  XX, YY, ZZ      coordinates of the end of an entity, or X, Y, Z; z points upwards. Those of an axis, or of another entity that has
                  parts, are where the first of these begins; from there to what bears it runs a link, which is nobody's
  diameter        of it, or diam, dia, TopDiameter, TopDia, or a radius; with BotDia the mean of both; without it that of the entity
                  before, at first 5 mm
  length          of the first entity of a trunk, which tells where that begins
  birth           the day on which it appears, or Date, or a column of dates (DD/MM, DD/MM/YY, MM/YY, DD/MM-TIME), from the first on
  plant           a name of the plant
  unit            in a comment line, "# unit: cm": of all lengths, m, dm, cm, mm, um or inch; "# unit TopDia: mm": of a column, which a
                  line of FEATURES may say behind the type, too
  up              in a comment line, "# up: y": what points upwards, z (as without it), y, x or one of these with -
  origin          in a comment line, "# origin: x y z": what is added to all coordinates, m

A row that begins with * is the entity above at a later date: its last measures count, and its first date.

Where a file says no unit, its numbers decide, with a warning: metres if the plant then is at most 150 m large, 12 m thick and at least
four times as large as thick; else the pair of units of lengths and of diameters with which it is sixty times as large as thick, or near;
of pairs that fit alike, millimetres before tenths of them.
I1<<I9 and I1++I9 are nine entities with the same features, of which the last has the coordinates; I1<.I9 gives features to the last
alone. ^ is the last entity of its column, or the last of the scale of what follows it. A class that CLASSES: does not list has the
scale of what it follows, or the next finer one. A file without coordinates, which has only topology, is refused.

--define DT=0.5 sets the days of a step. Each axis ends with a module Tip(order), where a model made by `espalier translate` can go on
to grow.
C. Godin, Y. Caraglio: A multiscale model of plant topological structures. Journal of Theoretical Biology 191, 1998.)",
     nullptr, [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return mtg::read_axes(std::move(text), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
