// Polygons that bend inward, cut into triangles: viewers fill a cell as if it were convex.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier {

/// Indices of corners, three a triangle. Empty for a polygon that may stay one cell: convex, or so crossed with itself
/// or so large that it cannot be cut. `normal` is the polygon's.
std::vector<std::uint32_t> triangles_of(std::span<const glm::dvec3> corners, const glm::dvec3& normal);

}  // namespace espalier
