// Bicubic patches whose sixteen control points the turtle walks to.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> begin_patch{
    {"@PS",
     {1, 2},
     "@PS(patch, basis): begin a patch of this number; 1 Bezier (also without basis), 2 B-spline, 3 Cardinal",
     [](Walk& walk, std::span<const double> parameters) {
         using enum BicubicPatch::Basis;
         const double basis = parameters.size() > 1 ? parameters[1] : 1;
         walk.patches.begin(walk, parameters[0], basis == 2 ? b_spline : basis == 3 ? cardinal : bezier);
     }}};

const Registered<Symbol> patch_point{
    {"@PC",
     {3},
     "@PC(patch, row, column): the turtle's position is this control point; both count from 0, or from 1",
     [](Walk& walk, std::span<const double> parameters) {
         walk.patches.mark(walk, parameters[0], parameters[1], parameters[2]);
     }}};

const Registered<Symbol> draw_patch{
    {"@PD",
     {1, 3},
     "@PD(patch, rows, columns): draw the patch, divided into so many quadrilaterals; 5 by 5 if left out",
     [](Walk& walk, std::span<const double> parameters) {
         const bool divided = parameters.size() == 3;
         walk.patches.draw(walk, parameters[0], divided ? parameters[1] : 5, divided ? parameters[2] : 5);
     }}};

const Registered<SymbolGroup> patches_group{
    {"patches",
     "patches of sixteen control points",
     {"@PS", "@PC", "@PD"},
     "A control point that is not set lies where the patch was begun. Rows and columns count from 0, or "
     "from 1 in a model that uses a 4 and no 0.",
     "derivation length: 17\n"
     "axiom: @PS(1) P(0)\n"
     "P(k) : k < 16 --> [ f(floor(k / 4)) -(90) f(k % 4) &(90) f(sin(70 * k)) @PC(1, floor(k / 4), k % 4) ] P(k + 1)\n"
     "P(k) --> @PD(1)"}};

}  // namespace
}  // namespace espalier::turtle
