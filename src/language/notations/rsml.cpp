// rsml: measured root systems in the Root System Markup Language (Lobet et al. 2015).
#include "espalier/language/notation.h"

#include "language/rsml/document.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"rsml", ".rsml", "measured root systems (Root System Markup Language, Lobet et al. 2015)",
     R"(Roots as polylines, laterals nested in the roots that bear them. They become the axiom of a model: as they are, or growing if the
nodes have times.

  <unit>         "cm"; m, cm, mm, um, dm or inch
  <resolution>   1; pixels per unit, for coordinates in pixels
  <up>           none; y or z, what points upwards. Without it, that is z if there is one, and the first root of the file ends
                 lower than it begins; points without z are of a picture whose y points downwards
  <parent-node>  property of a lateral; the node of its parent that it stands on, from 0; without it, the nearest one
  diameter       function, or property, of nodes; 0.5 mm if there is none
  node_creation_time, emergence_time or time  function of nodes; the day on which each appears

--define DT=0.5 sets the days of a step. Each root ends with a module Tip(order), where a model made by `espalier translate` can go on
to grow. G. Lobet et al.: Root System Markup Language. Plant Physiology 167, 2015.)",
     nullptr, [](const std::string& text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return rsml::read(text, path.string(), options);
     }}};

}  // namespace
}  // namespace espalier::language
