// Generalized cylinders: a cross-section swept along a smooth curve through control points.
#include "espalier/turtle/symbol.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace espalier::turtle {
namespace {

std::optional<double> first(std::span<const double> parameters) {
    return parameters.empty() ? std::nullopt : std::optional(parameters[0]);
}

/// An integer between two others; the smaller one for what is no number.
int bounded(double value, int least, int most) {
    return std::isnan(value) ? least : int(std::clamp(value, double(least), double(most)));
}

constexpr int most_sides = 256;

void set_radius_tangents(Walk& walk, std::span<const double> parameters) {
    for (const double parameter : parameters) {
        if (!std::isfinite(parameter)) walk.fail("a radius tangent that is not a number");
    }
    walk.change_brush([&](Brush& brush) {
        RadiusTangents radius = brush.radius.value_or(RadiusTangents{});
        if (parameters.size() == 1) {
            radius.scaled = parameters[0] != 0;
        } else {
            constexpr double degree = std::numbers::pi / 180;
            radius.angle_after = parameters[0] * degree;
            radius.length_after = parameters[1];
            radius.angle_before = parameters.size() == 4 ? parameters[2] * degree : radius.angle_after;
            radius.length_before = parameters.size() == 4 ? parameters[3] : radius.length_after;
        }
        brush.radius = radius;
    });
}

const Registered<Symbol> start_cylinder{
    {"@Gs", {0}, "@Gs: begin a generalized cylinder here", [](Walk& walk, std::span<const double>) {
         walk.cylinders.begin(walk, GeneralizedCylinder::Curve::open_hermite, {});
     }}};

const Registered<Symbol> control_point{
    {"@Gc",
     {0, 1},
     "@Gc(strips): a control point of the open cylinder, so many strips from the one before; 1 without parameter",
     [](Walk& walk, std::span<const double> parameters) { walk.cylinders.mark(walk, first(parameters)); }}};

const Registered<Symbol> end_cylinder{{"@Ge",
                                       {0, 1},
                                       "@Ge(strips): the last control point of the open cylinder, as @Gc",
                                       [](Walk& walk, std::span<const double> parameters) {
                                           walk.cylinders.mark(walk, first(parameters));
                                           walk.cylinders.end(walk, first(parameters));
                                       }}};

const Registered<Symbol> tangents{
    {"@Gt",
     {1, 2},
     "@Gt(start, end): tangents at the start and end of a stretch, in distances of its control points; "
     "1.2 at first, end as start if left out",
     [](Walk& walk, std::span<const double> parameters) {
         if (!std::isfinite(parameters[0] + parameters.back())) walk.fail("a tangent of no length");
         walk.change_brush([&](Brush& brush) {
             brush.tangent_after = parameters[0];
             brush.tangent_before = parameters.back();
         });
     }}};

const Registered<Symbol> radius_tangents{
    {"@Gr",
     {1, 2, 4},
     "@Gr(angle, length, angle, length): slopes of the radius at the start and end of a stretch; @Gr(1): their lengths "
     "count in distances of the control points, @Gr(0): in themselves",
     set_radius_tangents}};

const Registered<Symbol> contour{{"@#",
                                  {1},
                                  "@#(number): cross-section of cylinders from here on; 0 is the circle",
                                  [](Walk& walk, std::span<const double> parameters) {
                                      walk.change_brush([&](Brush& brush) {
                                          brush.contour = bounded(parameters[0], 0, 1 << 30);
                                          brush.cut = nullptr;
                                      });
                                  }}};

const Registered<Symbol> contour_sides{
    {"@!",
     {1},
     "@!(sides): polygons around cylinders and spheres from here on, 3 to 256",
     [](Walk& walk, std::span<const double> parameters) {
         walk.change_brush([&](Brush& brush) { brush.sides = bounded(parameters[0], 3, most_sides); });
     }}};

// In cpfg the turtle itself turns back what it rolled since its last segment.
const Registered<Symbol> least_twist{
    {"@Tp", {}, "@Tp: cylinders twist as little as possible from here on", [](Walk& walk, std::span<const double>) {
         walk.lose_rolls();
         walk.change_brush([](Brush& brush) { brush.follows_roll = false; });
     }}};

const Registered<Symbol> own_twist{
    {"@Tf", {}, "@Tf: cylinders follow the turtle's roll from here on", [](Walk& walk, std::span<const double>) {
         walk.keep_frame();
         walk.change_brush([](Brush& brush) { brush.follows_roll = true; });
     }}};

const Registered<SymbolGroup> cylinders_group{
    {"cylinders",
     "generalized cylinders",
     {"@Gs", "@Gc", "@Ge", "@Gt", "@Gr", "@#", "@!", "@Tp", "@Tf"},
     "A control point keeps position, heading, width, contour, colour and texture of the turtle. The curve "
     "runs through the control points in the direction of the headings (Hermite).\n"
     "In a branch, the first control point begins a new cylinder, which starts at the last control point "
     "of the parent axis.",
     "axiom: !(0.4) @Gs f(1) @Gc(8) +(30) !(0.3) f(1) @Gc(8) [-(60) !(0.2) f(1) @Ge(8)] f(1) @Ge(8)"}};

}  // namespace
}  // namespace espalier::turtle
