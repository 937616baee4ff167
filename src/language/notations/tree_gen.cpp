// tree-gen: species of Weber & Penn (1995) in the arrays of the add-on tree-gen.
#include "espalier/language/notation.h"

#include "language/weber_penn/species.h"
#include "language/weber_penn/translation.h"

namespace espalier::language {
namespace {

const Registered<NotationType> entry{
    {"tree-gen", ".py", "trees in the parameters of Weber & Penn (1995), in the arrays of tree-gen",
     R"(params = {
    'shape': 7,
    'g_scale': 13,
    'length': [1, 0.3, 0.6, 0],     # the trunk, its branches, ...
}

A dict of Python or an object of JSON; nothing in it is run. The parameters are those of `.species` files, where their units, ranges
and defaults stand (`espalier list notations species`), in small letters: g_scale is Scale, leaf_blos_num is Leaves, radius_mod is
nScale, and the third number of tropism is AttractionUp. base_size[0] is BaseSize. A list has a number for each level; those of
levels that the tree does not have are not read.

leaf_shape  4 maple, 5 palmate (three leaflets), 6 and 7 oak, 10 triangle; others are ovals
branch_dist, floor_splits, blossom_rate, branches[0], down_angle[0], rotate[0], tropism[0], tropism[1]  not read

A warning names what a file says and nothing reads. C. Hewitt: Procedural generation of tree models for use in computer graphics.
Dissertation, Cambridge 2017. See docs/species.md.)",
     [](const std::string& text, const std::filesystem::path& path) {
         return weber_penn::model_of(weber_penn::parse_tree_gen(text, path.string()), path.string());
     }}};

}  // namespace
}  // namespace espalier::language
