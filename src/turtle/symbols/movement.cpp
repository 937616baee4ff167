// Moving: F and G draw an internode, f and g do not; F and f mark a vertex of the open polygon.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

double distance(std::span<const double> parameters) {
    return parameters.empty() ? 1 : parameters[0];
}

const Registered<Symbol> draw{
    {"F",
     {},
     "F(length): move forward and draw an internode; marks a polygon vertex",
     [](Walk& walk, std::span<const double> parameters) { walk.move(distance(parameters), true, true); },
     Symbol::Effect::draws,
     Symbol::Step::draw}};

const Registered<Symbol> draw_unmarked{
    {"G",
     {},
     "G(length): move forward and draw an internode, marking no vertex",
     [](Walk& walk, std::span<const double> parameters) { walk.move(distance(parameters), true, false); },
     Symbol::Effect::draws,
     Symbol::Step::draw}};

const Registered<Symbol> skip{
    {"f",
     {},
     "f(length): move forward without drawing; marks a polygon vertex",
     [](Walk& walk, std::span<const double> parameters) { walk.move(distance(parameters), false, true); },
     Symbol::Effect::other,
     Symbol::Step::skip}};

const Registered<Symbol> skip_unmarked{
    {"g",
     {},
     "g(length): move forward without drawing, marking no vertex",
     [](Walk& walk, std::span<const double> parameters) { walk.move(distance(parameters), false, false); },
     Symbol::Effect::other,
     Symbol::Step::skip}};

const Registered<SymbolGroup> movement_group{
    {"movement",
     "moves ahead, with and without drawing",
     {"F", "G", "f", "g"},
     "Lengths are in metres, times the scale; without parameter 1. Before a drawn segment, tropisms bend "
     "the turtle.",
     "axiom: !(0.1) F(2) f(0.5) F(1) G(0.5)"}};

}  // namespace
}  // namespace espalier::turtle
