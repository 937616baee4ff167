// Branches: the turtle's state is kept at `[` and taken up again at `]`. The cut ends the drawing where a model says
// so.
#include "espalier/turtle/symbol.h"

namespace espalier {
namespace {

const Registered<Symbol> open{{"[", {}, "[: begin a branch", [](Walk& walk, std::span<const double>) { walk.push(); }}};

const Registered<Symbol> close{
    {"]", {}, "]: end a branch, back to where it began", [](Walk& walk, std::span<const double>) { walk.pop(); }}};

const Registered<Symbol> cut{{"%",
                              {0},
                              "%: cut the rest of the branch off in the next step; what follows may be left undrawn",
                              [](Walk& walk, std::span<const double>) {
                                  if (!walk.settings().past_cut) walk.stopped = true;
                              }}};

}  // namespace
}  // namespace espalier
