// Convex hulls of points: an area in the plane, a volume in space.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace espalier::analysis {

/// 0 if the points lie on a line. By Qhull (Barber, Dobkin & Huhdanpaa 1996).
double convex_hull_area(std::span<const glm::dvec2> points);

/// 0 if the points lie in a plane. By Qhull.
double convex_hull_volume(std::span<const glm::dvec3> points);

}  // namespace espalier::analysis
