// Polygons and generalized cylinders in braces: { opens one, F, f and . mark a polygon's vertices, } fills it. They may
// stand inside one another, and a polygon may reach across branches. With a type the brace begins a generalized
// cylinder, whose control points F and . mark.
#include "espalier/turtle/symbol.h"

#include <optional>

namespace espalier::turtle {
namespace {

std::optional<double> second(std::span<const double> parameters) {
    return parameters.size() > 1 ? std::optional(parameters[1]) : std::nullopt;
}

const Registered<Symbol> open_polygon{
    {"{",
     {},
     "{: begin a polygon. {(curve, strips): begin a generalized cylinder; 1 open Hermite curve, 2 closed, "
     "3 open B-spline, 4 closed",
     [](Walk& walk, std::span<const double> parameters) {
         const bool is_curve = !parameters.empty() && parameters[0] >= 1 && parameters[0] < 5;
         walk.polygons.begin(walk, !is_curve);
         if (!is_curve) return;
         walk.cylinders.begin(walk, GeneralizedCylinder::Curve(int(parameters[0])), second(parameters));
     }}};

const Registered<Symbol> close_polygon{
    {"}",
     {},
     "}: end the polygon and fill it; fewer than three vertices draw nothing. Ends a cylinder begun by {",
     [](Walk& walk, std::span<const double> parameters) {
         if (walk.polygons.is_unfilled()) walk.cylinders.end(walk, second(parameters));
         walk.polygons.end(walk);
     }}};

const Registered<Symbol> polygon_vertex{
    {".",
     {},
     ".: mark a vertex of the open polygon where the turtle is, unless the last one is "
     "there; .(strips): a control point of the open "
     "cylinder",
     [](Walk& walk, std::span<const double> parameters) {
         if (!parameters.empty()) return walk.cylinders.mark(walk, parameters[0]);
         if (walk.polygons.is_unfilled()) return walk.cylinders.mark(walk, {});
         walk.polygons.mark(walk);
     }}};

const Registered<SymbolGroup> polygon_group{
    {"polygon",
     "polygons",
     {"{", "}", "."},
     "Polygons can be nested: vertices belong to the innermost open one. A polygon may extend across "
     "branches; it has the colours and texture of its first vertex.\n"
     "With a parameter, braces and points make a generalized cylinder.",
     "axiom: !(0.06) F(1) { +(30) f(1) -(60) f(1) -(120) f(1) }"}};

}  // namespace
}  // namespace espalier::turtle
