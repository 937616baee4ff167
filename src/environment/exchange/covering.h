// Where voxels lie. Over a domain, whole voxels about its middle cover it; where there is none, the centre of voxel
// (0, 0, 0) is at the origin. docs/environment-processes.md tells users.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/geometry/plant_geometry.h"

#include <glm/vec3.hpp>

#include <optional>

namespace espalier::environment {

/// The setting `voxel`: metres, not smaller than fields can have them. Without `otherwise` it is required.
double read_voxel(const Settings& settings, std::optional<double> otherwise = std::nullopt);

/// The voxel that holds a place, where those are [i, i + 1) times `voxel`. Throws RunError for a place too far away to
/// be numbered.
glm::ivec3 voxel_at(const glm::dvec3& place, double voxel);

/// Whole voxels that cover an extent; a hair of rounding does not cost another one.
double voxels_across(double extent, double voxel);

/// How many voxels cover a domain along each axis.
glm::dvec3 voxels_over(const Box& domain, double voxel);

/// Where the voxels that cover a domain begin.
glm::dvec3 lower_corner_over(const Box& domain, double voxel);

}  // namespace espalier::environment
