// cylinders-text: the same tables as .txt, as TreeQSM writes them.
#include "espalier/language/notation.h"

#include "language/cylinders/dialect.h"
#include "language/cylinders/tree.h"

#include <utility>

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"cylinders-text", ".txt", "scanned trees as cylinders, as text (TreeQSM's cylinder files)",
     R"(The tables of `espalier list cylinders`, in files called .txt: those that save_model_text of TreeQSM writes, whose
start_point and axis_direction are three columns each, and other tables with tabs, commas or semicolons.
P. Raumonen et al.: Fast automatic precision tree models from terrestrial laser scanner data. Remote Sensing 5, 2013.)",
     nullptr,
     [](std::string text, const std::filesystem::path& path, const MeasuredOptions& options) {
         return cylinders::read(std::move(text), path.string(), options);
     },
     cylinders::is_cylinder_model}};

}  // namespace
}  // namespace espalier::language
