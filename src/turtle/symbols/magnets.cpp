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

}  // namespace
}  // namespace espalier::turtle
