// rsml: measured root systems in the Root System Markup Language (Lobet et al. 2015).
#include "espalier/language/notation.h"

#include "language/rsml/document.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"rsml", ".rsml", "measured root systems (Root System Markup Language, Lobet et al. 2015)",
     R"(Roots as polylines, laterals nested in the roots that bear them. They become the axiom of a model: as they are, or growing if the
nodes have times. Points count only in <geometry><polyline>. A lateral divides the segment on which it begins; one that begins beside
its parent hangs on it by a link, which is nobody's root. Roots without points are left out, and what they bear is borne by their
bearer. What the file says and is not used, and what was guessed, is named by warnings.

unit             cm; m, dm, cm, mm, um, inch or pixel, in <metadata>. A pixel is as wide as --pixel says, or as the property length makes
                 it, or else 1/300 inch, with a warning
resolution       1, > 0; pixels per unit, in <metadata>. It is not used beside coordinates below 0 and units other than the inch: those
                 are no pixels
up               none; x, y, z, -x, -y or -z, what points upwards. Without it: where z is 0 everywhere the file is flat, and y grows
                 downwards; in files of archiSimple and archiDART y grows downwards, too; else it is told by the axis along which
                 roots of first order run furthest
parent-node      none; an attribute, property or text of a lateral: the point of its parent that it stands on, from 0. Without it, that
                 is the nearest point of its parent's line
diameter         0.5 mm; function or property, or radius, rootDiameter. In the unit of its property-definition, or else of the
                 coordinates; in these, too, where it would else be larger than a tenth of the plant
node_creation_time  none; function or property, or creationTime, emergence_time, emergence, time: the day on which each node appears
age              none; function or property, d: the same, counted back from the oldest; taken as the day if it grows towards the tips
length           none; property, with which the lines are compared
continues        none; property: the ID of a root that stands before this one, which is a further piece of it, behind a gap

A function has a sample for each point (domain polyline), samples with positions along the root (length), or evenly spread ones
(uniform, with origin and step). It may stand in <function>, <function1> or <functions name="...">. Names may be in small or capital
letters, with - or _ or without.

--define DT=0.5 sets the days of a step. Each root ends with a module Tip(order), where a model made by `espalier translate` can go on
to grow. `espalier import` says what was read, and --unit, --up and --pixel overrule the file.
G. Lobet et al.: Root System Markup Language. Plant Physiology 167, 2015.)",
     nullptr, [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return rsml::read(std::move(text), path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
