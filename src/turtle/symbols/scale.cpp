// The scale of lengths and of widths set from now on.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

double factor(const Walk& walk, std::span<const double> parameters) {
    return parameters.empty() ? walk.settings().scale_multiplier : parameters[0];
}

const Registered<Symbol> set{
    {"@D", {1}, "@D(scale): set the scale", [](Walk& walk, std::span<const double> parameters) {
         walk.set_scale(parameters[0]);
     }}};

const Registered<Symbol> multiply{{"@Di",
                                   {},
                                   "@Di(factor): multiply the scale; by the scene's multiplier without parameter",
                                   [](Walk& walk, std::span<const double> parameters) {
                                       walk.set_scale(walk.turtle().scale * factor(walk, parameters));
                                   }}};

const Registered<Symbol> divide{{"@Dd",
                                 {},
                                 "@Dd(factor): divide the scale; by the scene's multiplier without parameter",
                                 [](Walk& walk, std::span<const double> parameters) {
                                     walk.set_scale(walk.turtle().scale / factor(walk, parameters));
                                 }}};

const Registered<SymbolGroup> scale_group{
    {"scale",
     "scale of lengths and widths",
     {"@D", "@Di", "@Dd"},
     "All lengths, widths and sizes of organs that follow are multiplied by the scale.",
     "axiom: !(0.1) F(1) @D(0.5) !(0.1) F(1) @Di(3) !(0.1) F(1)"}};

}  // namespace
}  // namespace espalier::turtle
