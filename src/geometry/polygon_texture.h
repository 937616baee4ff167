// Where pictures lie on polygons.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace espalier::geometry {

/// Texture coordinates of a polygon's corners: the picture fills the rectangle around the polygon whose v runs along
/// the polygon's longer axis, away from the first corner; along its first edge if no axis is longer. All 0 for a
/// polygon without area. `normal` is the polygon's, u to the right of v seen against it.
std::vector<glm::dvec2> texture_coordinates(std::span<const glm::dvec3> corners, const glm::dvec3& normal);

}  // namespace espalier::geometry
