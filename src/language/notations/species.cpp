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
A file may also be in the XML of Arbaro (W. Diestel), or in the arrays of tree-gen (C. Hewitt 2017), a dict of Python of which nothing
is run: params = {'g_scale': 13, 'length': [1, 0.3, 0.6, 0], ...}. There g_scale is Scale, leaf_blos_num Leaves, radius_mod nScale,
base_size[0] BaseSize, and tropism[2] AttractionUp; numbers of levels that the tree does not have are not read.
J. Weber, J. Penn: Creation and rendering of realistic trees. SIGGRAPH 1995. See docs/species.md.

)" + weber_penn::describe_parameters(),
     [](const std::string& text, const std::filesystem::path& path) {
         return weber_penn::model_of(weber_penn::parse(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
