// Cross-sections of cylinders that a ring of magnets pulls out and pushes in.
#include "espalier/turtle/symbol.h"

#include "geometry/magnetic_cut.h"

#include <cmath>

namespace espalier::turtle {
namespace {

void set_cut(Walk& walk, std::span<const double> parameters, bool flat) {
    for (const double parameter : parameters) {
        if (!std::isfinite(parameter)) walk.fail("a magnet whose strength is not a number");
    }
    geometry::MagneticCut cut;
    cut.flat = flat;
    if (!parameters.empty()) {
        cut.thickness = parameters[0];
        cut.strengths.assign(parameters.begin() + 1, parameters.end());
    }
    walk.change_brush([&](Brush& brush) { brush.cut = std::make_shared<Contour>(std::move(cut)); });
}

const Registered<Symbol> solid{
    {"@Gm",
     {},
     "@Gm(thickness, strengths...): cross-section of cylinders from here on: an ellipse, so thick in widths, whose "
     "outline magnets at equal angles from up to the right pull out, or push in, by their strengths in radii",
     [](Walk& walk, std::span<const double> parameters) { set_cut(walk, parameters, false); }}};

const Registered<Symbol> flat{
    {"@Gf",
     {},
     "@Gf(thickness, strengths...): a flat cross-section: the line half-way between the upper and the lower outline of "
     "@Gm with the same parameters",
     [](Walk& walk, std::span<const double> parameters) { set_cut(walk, parameters, true); }}};

const Registered<SymbolGroup> magnets_group{
    {"magnets",
     "cross-sections that magnets shape",
     {"@Gm", "@Gf"},
     "At a magnet of strength s, the outline lies 1 + s times as far from the middle as that of the "
     "ellipse, at least 0. Between two magnets it changes smoothly (Steffen 1990).",
     "axiom: !(0.5) @Gm(1, 1, 0, 1, 0, 1, 0) @Gs f(1) @Gc(4) f(1) @Ge(4)"}};

}  // namespace
}  // namespace espalier::turtle
