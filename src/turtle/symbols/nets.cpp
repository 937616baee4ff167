// Nets: surfaces through points that the turtle marks row by row.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> begin_net{
    {"@Nb",
     {1},
     "@Nb(columns): begin a net of points with so many in each row",
     [](Walk& walk, std::span<const double> parameters) { walk.nets.begin(walk, parameters[0]); }}};

const Registered<Symbol> net_point{
    {"@Np", {0}, "@Np: the turtle's position is the next point of the net", [](Walk& walk, std::span<const double>) {
         walk.nets.mark(walk);
     }}};

const Registered<Symbol> end_net{
    {"@Ne",
     {0},
     "@Ne: draw the net; u runs along its rows and v from the first row to the last, 0 to 1",
     [](Walk& walk, std::span<const double>) { walk.nets.draw(walk); }}};

const Registered<SymbolGroup> nets_group{
    {"nets",
     "surfaces through rows of points",
     {"@Nb", "@Np", "@Ne"},
     "Points belong to the innermost open net; a row that is not full is left out. Each four points are "
     "joined by two triangles.",
     "axiom: @Nb(3) [+(90) f(1) @Np] @Np [-(90) f(1) @Np] f(2) [+(90) f(0.5) @Np] @Np [-(90) f(0.5) @Np] @Ne"}};

}  // namespace
}  // namespace espalier::turtle
