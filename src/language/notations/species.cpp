// species: trees in the parameters of J. Weber and J. Penn (1995).
#include "language/weber_penn/species.h"

#include "espalier/language/notation.h"

#include "language/weber_penn/translation.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"species", ".species", "trees in the parameters of Weber & Penn (1995)",
     R"(Lines `name = value`, or `name, name = value, value`; // and /* */ begin comments. A digit in front is the level of
the stems, 0 for the trunk; levels deeper than 3 are like 3. Leaves have the angles of the level after the last.
n stands for 0 to 3, or 1 to 3 if three defaults are given. A parameter with V says by how much another varies, up or down.
J. Weber, J. Penn: Creation and rendering of realistic trees. SIGGRAPH 1995. See docs/species.md.

)" + weber_penn::describe_parameters(),
     [](const std::string& text, const std::filesystem::path& path) {
         return weber_penn::model_of(weber_penn::parse(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
