// The width of what F and G draw: set, in units of the scale, or changed by the model's increment.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

void change_width(Walk& walk, std::span<const double> parameters, double increment) {
    if (parameters.empty() && increment == 0) return;
    walk.set_width(parameters.empty() ? walk.turtle().width + increment : parameters[0] * walk.turtle().scale);
}

const Registered<Symbol> wider{
    {"#",
     {},
     "#(width): set the line width, times the scale; without parameter, widen by the increment",
     [](Walk& walk, std::span<const double> parameters) {
         change_width(walk, parameters, walk.settings().line_width_increment);
     }}};

const Registered<Symbol> narrower{
    {"!",
     {},
     "!(width): set the line width, times the scale; without parameter, narrow by the increment",
     [](Walk& walk, std::span<const double> parameters) {
         change_width(walk, parameters, -walk.settings().line_width_increment);
     }}};

}  // namespace
}  // namespace espalier::turtle
