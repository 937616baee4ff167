// arbaro: species of Weber & Penn (1995) in the XML of the program Arbaro.
#include "espalier/language/notation.h"

#include "language/weber_penn/species.h"
#include "language/weber_penn/translation.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"arbaro", ".xml", "trees in the parameters of Weber & Penn (1995), in the XML of Arbaro",
     R"(A file has the parameters of one species:

    <arbaro><species name="aspen">
    <param name="Shape" value="7"/> <param name="1Length" value="0.3"/>
    </species></arbaro>

The parameters are those of `.species` files, with the same units, ranges and defaults: `espalier list notations species`. LeafShape may be a
word: disc and disc1 to disc9 are ovals.

Smooth      not read: it shades the facets of Arbaro's meshes
0DownAngle, 0DownAngleV, 0Rotate, 0RotateV, 0Branches, 0BranchDist  not read: there is one trunk, and it stands upright

A warning names what a file says and nothing reads. Arbaro is a program by W. Diestel (2003 to 2012). See docs/species.md.)",
     [](const std::string& text, const std::filesystem::path& path) {
         return weber_penn::model_of(weber_penn::parse_arbaro(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
