// Convex hulls of points: an area in the plane, a volume in space.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace espalier::analysis {

/// By Andrew's monotone chain (1979). 0 if the points lie on a line.
double convex_hull_area(std::vector<glm::dvec2> points);

/// By Quickhull (Barber, Dobkin & Huhdanpaa 1996). 0 if the points lie, to 1e-10 of their extent, in a plane.
double convex_hull_volume(std::span<const glm::dvec3> points);

}  // namespace espalier::analysis
