// Vectors of polygons and across directions.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>

namespace espalier::geometry {

/// The area of a polygon times its normal, which corners that lie in no plane or in line do not disturb (Newell's
/// method). `corner(i)` is corner i of `count`.
template <class Corner>
glm::dvec3 area_vector(std::size_t count, const Corner& corner) {
    glm::dvec3 twice(0);
    if (count == 0) return twice;
    const glm::dvec3 first(corner(0));
    for (std::size_t i = 2; i < count; ++i) {
        twice += glm::cross(glm::dvec3(corner(i - 1)) - first, glm::dvec3(corner(i)) - first);
    }
    return twice / 2.0;
}

/// The vector with the length 1, or `other` if it has no length.
inline glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& other) {
    const double length = glm::length(vector);
    return length > 0 ? vector / length : other;
}

/// An axis of the world that is far from `direction`, of unit length.
inline glm::dvec3 axis_apart_from(const glm::dvec3& direction) {
    return std::abs(direction.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
}

/// A unit vector at right angles to `direction`, of unit length.
inline glm::dvec3 any_across(const glm::dvec3& direction) {
    const glm::dvec3 other = axis_apart_from(direction);
    return glm::normalize(other - direction * glm::dot(other, direction));
}

}  // namespace espalier::geometry
