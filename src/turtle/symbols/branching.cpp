// Branches: the turtle's state is kept at `[` and taken up again at `]`. The cut ends the drawing where a model says
// so.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> open{{"[", {}, "[: begin a branch", [](Walk& walk, std::span<const double>) { walk.push(); }}};

const Registered<Symbol> close{
    {"]", {}, "]: end a branch and restore the state of the turtle", [](Walk& walk, std::span<const double>) {
         walk.pop();
     }}};

const Registered<Symbol> cut{
    {"%",
     {0},
     "%: remove the rest of the branch in the next step; past_cut = false: nothing after it is drawn",
     [](Walk& walk, std::span<const double>) {
         if (!walk.settings().past_cut) walk.stopped = true;
     }}};

}  // namespace
}  // namespace espalier::turtle
