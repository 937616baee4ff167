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
     },
     Symbol::Effect::other,
     Symbol::Step::width}};

const Registered<Symbol> narrower{
    {"!",
     {},
     "!(width): set the line width, times the scale; without parameter, narrow by the increment",
     [](Walk& walk, std::span<const double> parameters) {
         change_width(walk, parameters, -walk.settings().line_width_increment);
     },
     Symbol::Effect::other,
     Symbol::Step::width}};

const Registered<SymbolGroup> width_group{
    {"width",
     "line widths",
     {"#", "!"},
     "Widths are in metres, the thickness of what is drawn from here on, times the scale; at least 1e-7. A "
     "line without a width is drawn thin.",
     "axiom: !(0.2) F(1) !(0.1) F(1) #(0.3) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
