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

const Contour* contour_of(const Walk& walk) {
    if (walk.brush().cut) return walk.brush().cut.get();
    if (!walk.settings().shapes) return nullptr;
    const auto found = walk.settings().shapes->contours.find(walk.brush().contour);
    return found == walk.settings().shapes->contours.end() ? nullptr : &found->second;
}

}  // namespace

void OpenCylinders::begin(Walk& walk, GeneralizedCylinder::Curve curve, std::optional<double> strips) {
    if (walk.turtle().cylinder >= 0 && !walk.turtle().branches_off) draw(walk, walk.turtle().cylinder);
    Open open;
    open.cylinder.curve = curve;
    open.cylinder.sides = walk.brush().sides;
    if (walk.settings().shapes && walk.turtle().texture >= 1 &&
        walk.turtle().texture <= walk.settings().shapes->textures.size()) {
        const double ratio = walk.settings().shapes->textures[walk.turtle().texture - 1u].ratio;
        if (ratio > 0 && std::isfinite(ratio)) open.cylinder.texture_ratio = ratio;
    }
    open.strips = strips_of(strips, 1);
    open.last_is_marked = false;
    walk.turtle().cylinder = std::int32_t(open_.size());
    walk.turtle().branches_off = false;
    open_.push_back(std::move(open));
    record(walk, {}, false);
}

void OpenCylinders::branch(Walk& walk) {
    const Open& parent = open_[std::size_t(walk.turtle().cylinder)];
    Open open;
    open.cylinder.curve = parent.cylinder.curve;
    // Only the axis itself can come back to its beginning.
    using enum GeneralizedCylinder::Curve;
    if (open.cylinder.curve == closed_hermite) open.cylinder.curve = open_hermite;
    if (open.cylinder.curve == closed_spline) open.cylinder.curve = open_spline;
    open.cylinder.sides = walk.brush().sides;
    open.cylinder.texture_ratio = parent.cylinder.texture_ratio;
    // One that begins within a polygon may have no point yet.
    if (!parent.cylinder.points.empty()) open.cylinder.points = {parent.cylinder.points.back()};
    open.strips = parent.strips;
    open.last_is_marked = true;
    walk.turtle().cylinder = std::int32_t(open_.size());
    walk.turtle().branches_off = false;
    open_.push_back(std::move(open));
}

void OpenCylinders::record(Walk& walk, std::optional<double> strips, bool marked) {
    if (walk.turtle().cylinder < 0) return;
    // What F draws in a branch, or between the vertices of a polygon, is no part of the cylinder around it.
    if (!marked && (walk.turtle().branches_off || walk.polygons.is_filled())) return;
    if (walk.turtle().branches_off) branch(walk);
    Open& open = open_[std::size_t(walk.turtle().cylinder)];
    std::vector<CylinderPoint>& points = open.cylinder.points;

    CylinderPoint point{walk.module(), walk.turtle().order, std::uint16_t(walk.turtle().colour), walk.look(),
                        walk.turtle().pose};
    point.width = walk.turtle().width;
    point.contour = contour_of(walk);
    point.strips = strips_of(strips, open.strips);
    point.tangent_before = walk.brush().tangent_before;
    point.tangent_after = walk.brush().tangent_after;
    point.radius = walk.brush().radius;
    point.follows_roll = walk.brush().follows_roll;
    open.cylinder.sides = std::max(open.cylinder.sides, walk.brush().sides);

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

void OpenCylinders::end(Walk& walk, std::optional<double> strips) {
    if (walk.turtle().cylinder < 0) return;
    if (!walk.turtle().branches_off) {
        using enum GeneralizedCylinder::Curve;
        Open& open = open_[std::size_t(walk.turtle().cylinder)];
        std::vector<CylinderPoint>& points = open.cylinder.points;
        if (open.cylinder.curve == closed_hermite || open.cylinder.curve == closed_spline) {
            if (points.size() > 3 && same_place(points.front(), points.back())) points.pop_back();
            points.front().strips = strips_of(strips, points.back().strips);  // the stretch that closes it
        } else {
            record(walk, {}, false);
        }
        draw(walk, walk.turtle().cylinder);
    }
    walk.turtle().cylinder = -1;
}

void OpenCylinders::draw(const Walk& walk, std::int32_t number) {
    GeneralizedCylinder& cylinder = open_[std::size_t(number)].cylinder;
    geometry::draw(cylinder, walk.geometry());
    cylinder.points = {};
    walk.require_room();
}

void OpenCylinders::draw_all(const Walk& walk) {
    for (std::size_t i = 0; i < open_.size(); ++i) draw(walk, std::int32_t(i));
}

}  // namespace espalier::turtle
