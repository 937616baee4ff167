// The solids of background scenes, each about the place its command says, as triangles.
#pragma once

#include "espalier/geometry/surface.h"

#include <cstdint>
#include <vector>

namespace espalier::turtle {

struct Solid {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> triangles;  ///< three indices each
};

/// A corner at the origin.
Solid solid_box(const glm::dvec3& size);
/// Along +y from the origin, with discs at its ends.
Solid solid_cone(double base_radius, double top_radius, double height);
/// About the origin.
Solid solid_sphere(double radius);

/// The normal of a polygon whose vertices need not lie in a plane quite (Newell 1972); unit length.
glm::dvec3 fan_normal(const std::vector<SurfaceVertex>& vertices);

}  // namespace espalier::turtle
