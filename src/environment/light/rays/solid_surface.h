// The surface of a solid as triangles.
#pragma once

#include "espalier/environment/shape.h"

#include "environment/space/shapes/triangles.h"

namespace espalier::environment {

/// From its distances at the corners of voxels (dual contouring); edges are rounded within a voxel. Corners run
/// counter-clockwise as seen from outside. Throws RunError for a solid without bounds or of more than 2^27 voxels.
TriangleMesh surface_of(const Shape& solid, double voxel);

}  // namespace espalier::environment
