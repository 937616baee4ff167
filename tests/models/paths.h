// Shared by the tests of curves: the points a turtle passed, and what is asked of them.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace espalier {

/// Equal for points that are the same but for rounding.
using PointKey = std::array<long long, 3>;

inline PointKey key(const glm::dvec3& point) {
    return {std::llround(point.x * 1e4), std::llround(point.y * 1e4), std::llround(point.z * 1e4)};
}

/// The base of the first internode and the tips of all: the corners of one unbroken line.
inline std::vector<glm::dvec3> corners(const PlantGeometry& geometry) {
    std::vector<glm::dvec3> points;
    if (geometry.internodes.empty()) return points;
    points.push_back(geometry.internodes.front().base);
    for (const Internode& internode : geometry.internodes) points.push_back(internode.tip);
    return points;
}

inline std::set<PointKey> distinct(const std::vector<glm::dvec3>& points) {
    std::set<PointKey> keys;
    for (const glm::dvec3& point : points) keys.insert(key(point));
    return keys;
}

/// Edges without direction.
inline std::set<std::array<PointKey, 2>> edges(const PlantGeometry& geometry) {
    std::set<std::array<PointKey, 2>> keys;
    for (const Internode& internode : geometry.internodes) {
        PointKey a = key(internode.base), b = key(internode.tip);
        if (b < a) std::swap(a, b);
        keys.insert({a, b});
    }
    return keys;
}

/// Returns the area of a polygon in the x-y plane.
inline double enclosed_area(const std::vector<glm::dvec3>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2;
}

/// Returns the size of the box around the points.
inline glm::dvec3 extent(const std::vector<glm::dvec3>& points) {
    Box box;
    for (const glm::dvec3& point : points) box.add(point);
    return box.upper - box.lower;
}

/// True if a line of unit steps passes each of the `side`^`dimensions` points of a square or cube exactly once.
inline bool visits_each_cell_once(const PlantGeometry& geometry, int side, int dimensions) {
    const std::vector<glm::dvec3> points = corners(geometry);
    std::size_t cells = 1;
    for (int i = 0; i < dimensions; ++i) cells *= static_cast<std::size_t>(side);
    if (points.size() != cells || distinct(points).size() != cells) return false;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (std::abs(glm::length(points[i + 1] - points[i]) - 1) > 1e-9) return false;
    }
    const glm::dvec3 size = extent(points);
    const double wanted = side - 1;
    int directions = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(size[axis] - wanted) < 1e-6) ++directions;
        if (size[axis] > wanted + 1e-6) return false;
    }
    return directions >= dimensions;
}

}  // namespace espalier
