// Absolute position, in the coordinates of the world.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> position{
    {"@M",
     {2, 3},
     "@M(x, y, z): go to this position without drawing; z is 0 if left out",
     [](Walk& walk, std::span<const double> parameters) {
         walk.jump({parameters[0], parameters[1], parameters.size() > 2 ? parameters[2] : 0});
     }}};

}  // namespace
}  // namespace espalier::turtle
