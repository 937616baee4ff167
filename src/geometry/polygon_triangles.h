// Polygons cut into triangles: viewers fill a cell as if it were convex.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::geometry {

struct EarCut {
    std::vector<std::uint32_t> triangles;  ///< indices of corners, three a triangle
    bool complete = false;                 ///< false if the polygon is degenerate or crosses itself
};

/// Cuts ears off a simple polygon (Meisters 1975), the one with the smallest perimeter^2 / area first: the rule, and
/// the order among equal ears, of VTK's vtkPolygon.
EarCut cut_ears(std::span<const glm::dvec3> corners);

/// Indices of corners, three a triangle. Empty for a polygon that may stay one cell: convex, or so crossed with itself
/// or so large that it cannot be cut. `normal` is the polygon's.
std::vector<std::uint32_t> triangles_of(std::span<const glm::dvec3> corners, const glm::dvec3& normal);

}  // namespace espalier::geometry
