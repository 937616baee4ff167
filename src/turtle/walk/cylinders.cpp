// Generalized cylinders as a walk meets them: control points now, their surface when the cylinder ends.
#include "espalier/turtle/walk.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::turtle {
namespace {

constexpr double most_strips = 1000;

int strips_of(std::optional<double> wanted, int fallback) {
    if (!wanted || std::isnan(*wanted)) return fallback;
    return int(std::clamp(*wanted, 1.0, most_strips));
}

bool same_place(const CylinderPoint& a, const CylinderPoint& b) {
    const double size = glm::length(a.pose.position) + a.width;
    return glm::distance(a.pose.position, b.pose.position) <= 1e-9 * size;
}

}  // namespace

const Contour* Walk::contour() const {
    if (brush().cut) return brush().cut.get();
    if (!settings_->shapes) return nullptr;
    const auto found = settings_->shapes->contours.find(brush().contour);
    return found == settings_->shapes->contours.end() ? nullptr : &found->second;
}

void Walk::begin_cylinder(GeneralizedCylinder::Curve curve, std::optional<double> strips) {
    if (turtle().cylinder >= 0 && !turtle().branches_off) draw_cylinder(turtle().cylinder);
    OpenCylinder open;
    open.cylinder.curve = curve;
    open.cylinder.sides = brush().sides;
    if (settings_->shapes && turtle().texture >= 1 && turtle().texture <= settings_->shapes->textures.size()) {
        const double ratio = settings_->shapes->textures[turtle().texture - 1u].ratio;
        if (ratio > 0 && std::isfinite(ratio)) open.cylinder.texture_ratio = ratio;
    }
    open.strips = strips_of(strips, 1);
    open.last_is_marked = false;
    turtle().cylinder = std::int32_t(cylinders.size());
    turtle().branches_off = false;
    cylinders.push_back(std::move(open));
    record_control_point({}, false);
}

void Walk::branch_cylinder() {
    const OpenCylinder& parent = cylinders[std::size_t(turtle().cylinder)];
    OpenCylinder open;
    open.cylinder.curve = parent.cylinder.curve;
    // Only the axis itself can come back to its beginning.
    using enum GeneralizedCylinder::Curve;
    if (open.cylinder.curve == closed_hermite) open.cylinder.curve = open_hermite;
    if (open.cylinder.curve == closed_spline) open.cylinder.curve = open_spline;
    open.cylinder.sides = brush().sides;
    open.cylinder.texture_ratio = parent.cylinder.texture_ratio;
    // One that begins within a polygon may have no point yet.
    if (!parent.cylinder.points.empty()) open.cylinder.points = {parent.cylinder.points.back()};
    open.strips = parent.strips;
    open.last_is_marked = true;
    turtle().cylinder = std::int32_t(cylinders.size());
    turtle().branches_off = false;
    cylinders.push_back(std::move(open));
}

void Walk::record_control_point(std::optional<double> strips, bool marked) {
    if (turtle().cylinder < 0) return;
    // What F draws in a branch, or between the vertices of a polygon, is no part of the cylinder around it.
    if (!marked && (turtle().branches_off || (!open_polygons.empty() && open_polygons.back().filled))) return;
    if (turtle().branches_off) branch_cylinder();
    OpenCylinder& open = cylinders[std::size_t(turtle().cylinder)];
    std::vector<CylinderPoint>& points = open.cylinder.points;

    CylinderPoint point{module_, turtle().order, std::uint16_t(turtle().colour), look(), turtle().pose};
    point.width = turtle().width;
    point.contour = contour();
    point.strips = strips_of(strips, open.strips);
    point.tangent_before = brush().tangent_before;
    point.tangent_after = brush().tangent_after;
    point.radius = brush().radius;
    point.follows_roll = brush().follows_roll;
    open.cylinder.sides = std::max(open.cylinder.sides, brush().sides);

    if (!points.empty() && same_place(points.back(), point)) {
        const CylinderPoint& last = points.back();
        if (!open.last_is_marked) {
            if (!strips) point.strips = last.strips;
            points.back() = point;
            open.last_is_marked = marked;
            return;
        }
        if (!marked || (last.width == point.width && last.contour == point.contour)) return;
    }
    points.push_back(point);
    open.last_is_marked = marked;
}

void Walk::control_point(std::optional<double> strips) {
    record_control_point(strips, true);
}

void Walk::end_cylinder(std::optional<double> strips) {
    if (turtle().cylinder < 0) return;
    if (!turtle().branches_off) {
        using enum GeneralizedCylinder::Curve;
        OpenCylinder& open = cylinders[std::size_t(turtle().cylinder)];
        std::vector<CylinderPoint>& points = open.cylinder.points;
        if (open.cylinder.curve == closed_hermite || open.cylinder.curve == closed_spline) {
            if (points.size() > 3 && same_place(points.front(), points.back())) points.pop_back();
            points.front().strips = strips_of(strips, points.back().strips);  // the stretch that closes it
        } else {
            record_control_point({}, false);
        }
        draw_cylinder(turtle().cylinder);
    }
    turtle().cylinder = -1;
}

void Walk::draw_cylinder(std::int32_t number) {
    GeneralizedCylinder& cylinder = cylinders[std::size_t(number)].cylinder;
    draw(cylinder, *geometry_);
    cylinder.points = {};
    require_room();
}

/// A plant whose mesh no timeline could hold ends here instead of in the memory of the machine.
void Walk::require_room() const {
    constexpr std::size_t most_vertices = std::size_t{1} << 27;
    if (geometry_->mesh.vertices.size() > most_vertices)
        fail("the plant's surfaces have more than 134 million vertices");
}

void Walk::finish() {
    for (std::size_t i = 0; i < cylinders.size(); ++i) draw_cylinder(std::int32_t(i));
    while (!nets.empty()) draw_net();
    while (!deformations.empty()) end_deformation();
}

}  // namespace espalier::turtle
