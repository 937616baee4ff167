// Branches: the turtle's state is kept at `[` and taken up again at `]`. The cut ends the drawing where a model says
// so.
#include "espalier/turtle/symbol.h"

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

const Registered<SymbolGroup> branching_group{
    {"branching",
     "begins, ends and cuts branches",
     {"[", "]", "%"},
     "A branch begins with the state of the turtle at its [, and ] restores that state: position, "
     "directions, width, colours, scale, tropisms.\n"
     "A ] without [ has no effect, and a [ without ] reaches to the end of the string.",
     "axiom: !(0.06) F(1) [+(40) F(1)] [-(40) F(1)] F(1)"}};

}  // namespace
}  // namespace espalier::turtle
