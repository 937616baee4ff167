// cylinders: trees of cylinders that were fitted to scanned points, as CSV.
#include "espalier/language/notation.h"

#include "language/cylinders/dialect.h"
#include "language/cylinders/tree.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"cylinders", ".csv", "scanned trees as cylinders (TreeQSM, rTwig, SimpleForest, aRchi)",
     R"(A table of cylinders that a program fitted to scanned points becomes the axiom of a model. Its header tells which program
wrote it; it is separated by commas, semicolons or tabs.

  TreeQSM       radius, length, start, axis, parent, extension, branch; numbers are the rows, from 1, and 0 is the parent of the
                first. rTwig writes the same columns, and so does writetable(struct2table(QSM.cylinder), 'tree.csv') of MATLAB;
                Rad, Len, Sta, Axe, CPar, CExt, BoC are those of TreeQSM 2
  SimpleForest  ID, parentID, startX ... endZ, radius, length, branchID; numbers from 0, and -1 is the parent of the first
  aRchi         cyl_ID, parent_ID, extension_ID, startX ... endZ, radius_cyl, length, axis_ID; numbers from 1

Lengths are metres, and z points upwards. Each cylinder keeps its length: the piece between cylinders that do not meet, and from
a branch's beginning on the surface of its bearer to that one's axis, is a link, which is nobody's wood. A branch goes on by
its extension, or else by the first cylinder with its number. radius is drawn, and UnmodRadius, the fit before it was corrected, is not.
Each cylinder without parent begins a plant of its own.
P. Raumonen et al.: Fast automatic precision tree models from terrestrial laser scanner data. Remote Sensing 5, 2013.
J. Hackenberg et al.: SimpleTree, an efficient open source tool to build tree models from TLS clouds. Forests 6, 2015.)",
     nullptr,
     [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return cylinders::read(std::move(text), path.string(), options);
     },
     cylinders::is_cylinder_model}};

}  // namespace
}  // namespace espalier::language
