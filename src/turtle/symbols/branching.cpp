// Branches: the turtle's state is kept at `[` and taken up again at `]`. The cut ends the drawing where a model says
// so.
#include "espalier/turtle/symbol.h"

#include <algorithm>
#include <cmath>

namespace espalier::turtle {
namespace {

const Registered<Symbol> open{{"[",
                               {},
                               "[: begin a branch",
                               [](Walk& walk, std::span<const double>) { walk.push(); },
                               Symbol::Effect::other,
                               Symbol::Step::open}};

const Registered<Symbol> close{{"]",
                                {},
                                "]: end a branch and restore the state of the turtle",
                                [](Walk& walk, std::span<const double>) { walk.pop(); },
                                Symbol::Effect::other,
                                Symbol::Step::close}};

const Registered<Symbol> cut{
    {"%",
     {0},
     "%: remove the rest of the branch in the next step; past_cut = false: nothing after it is drawn",
     [](Walk& walk, std::span<const double>) {
         if (!walk.settings().past_cut) walk.stopped = true;
     }}};

const Registered<Symbol> axis{
    {"@Ax",
     {1},
     "@Ax(order): the axis from here on is of this order, 0 to 65535; its branches have the next",
     [](Walk& walk, std::span<const double> parameters) {
         walk.turtle().order = static_cast<std::uint16_t>(std::clamp(std::floor(parameters[0]), 0.0, 65535.0));
     }}};

const Registered<SymbolGroup> branching_group{
    {"branching",
     "begins, ends and cuts branches",
     {"[", "]", "%", "@Ax"},
     "A branch begins with the state of the turtle at its [, and ] restores that state: position, "
     "directions, width, colours, scale, tropisms.\n"
     "A ] without [ has no effect, and a [ without ] reaches to the end of the string.\n"
     "An axis has the order of the branch it stands in, 0 for the main axis; @Ax(0) makes one in brackets a main axis, "
     "as each "
     "of several roots that begin at the seed.",
     "axiom: !(0.06) F(1) [+(40) F(1)] [-(40) F(1)] F(1)"}};

}  // namespace
}  // namespace espalier::turtle
