// Where voxels lie. Over a domain, whole voxels about its middle cover it; where there is none, the centre of voxel
// (0, 0, 0) is at the origin. docs/environment-processes.md tells users.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/vec3.hpp>

namespace espalier::environment {

/// Whole voxels that cover an extent; a hair of rounding does not cost another one.
double voxels_across(double extent, double voxel);

/// How many voxels cover a domain along each axis.
glm::dvec3 voxels_over(const Box& domain, double voxel);

/// Where the voxels that cover a domain begin.
glm::dvec3 lower_corner_over(const Box& domain, double voxel);

}  // namespace espalier::environment
