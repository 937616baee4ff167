// Absolute position, in the coordinates of the world.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> position{
    {"@M",
     {2, 3},
     "@M(x, y, z): go to this position without drawing; z is 0 if it is left out",
     [](Walk& walk, std::span<const double> parameters) {
         walk.jump({parameters[0], parameters[1], parameters.size() > 2 ? parameters[2] : 0});
     }}};

const Registered<SymbolGroup> position_group{{"position",
                                              "jumps to a place",
                                              {"@M"},
                                              "The place is in coordinates of the world, in metres.",
                                              "axiom: !(0.06) F(1) @M(0.5, 0.5) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
