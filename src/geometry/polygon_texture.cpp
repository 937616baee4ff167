#include "geometry/polygon_texture.h"

#include "espalier/base/math.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace espalier::geometry {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Corners in the plane of a polygon, its first at the origin.
struct Flat {
    std::vector<glm::dvec2> corners;
    double area = 0;
    glm::dvec2 middle{0};           ///< middle of the area
    double xx = 0, xy = 0, yy = 0;  ///< second moments about the middle
};

Flat flattened(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const glm::dvec3 other = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, normal)), y = glm::cross(normal, x);
    Flat flat;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 here = corner - corners[0];
        flat.corners.emplace_back(glm::dot(here, x), glm::dot(here, y));
    }
    glm::dvec2 first(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 &a = flat.corners[i], &b = flat.corners[(i + 1) % corners.size()];
        const double twice = cross(a, b);
        flat.area += twice / 2;
        first += (a + b) * (twice / 6);
        flat.xx += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
        flat.yy += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
        flat.xy += twice * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
    }
    if (flat.area == 0) return flat;
    flat.middle = first / flat.area;
    flat.xx -= flat.area * flat.middle.x * flat.middle.x;
    flat.yy -= flat.area * flat.middle.y * flat.middle.y;
    flat.xy -= flat.area * flat.middle.x * flat.middle.y;
    return flat;
}

/// The direction of v, a unit vector.
glm::dvec2 upward(const Flat& flat) {
    constexpr double about_equal = 0.01;  // for squares and circles, but for rounding
    const double spread = math::hypot(flat.xx - flat.yy, 2 * flat.xy), sum = std::abs(flat.xx + flat.yy);
    if (spread <= about_equal * sum) {
        for (const glm::dvec2& corner : flat.corners) {
            if (const double length = glm::length(corner); length > 0) return corner / length;
        }
    }
    const double angle = math::atan2(2 * flat.xy, flat.xx - flat.yy) / 2 + (flat.area < 0 ? math::acos(0.0) : 0.0);
    const glm::dvec2 axis(math::cos(angle), math::sin(angle));
    return glm::dot(flat.middle, axis) < 0 ? -axis : axis;
}

}  // namespace

std::vector<glm::dvec2> texture_coordinates(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const Flat flat = flattened(corners, normal);
    std::vector<glm::dvec2> uvs(corners.size(), glm::dvec2(0));
    if (!(std::abs(flat.area) > 0)) return uvs;
    const glm::dvec2 v = upward(flat), u(v.y, -v.x);
    glm::dvec2 lower(std::numeric_limits<double>::max()), upper(-std::numeric_limits<double>::max());
    for (std::size_t i = 0; i < uvs.size(); ++i) {
        uvs[i] = {glm::dot(flat.corners[i], u), glm::dot(flat.corners[i], v)};
        lower = glm::min(lower, uvs[i]);
        upper = glm::max(upper, uvs[i]);
    }
    for (glm::dvec2& uv : uvs) uv = (uv - lower) / glm::max(upper - lower, glm::dvec2(1e-300));
    return uvs;
}

}  // namespace espalier::geometry
