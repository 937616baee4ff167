// What a tip senses: content, gradient, and a way past obstacles.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/grid/solids.h"

namespace espalier::environment {

struct WaterSample {
    WaterStencil stencil;  ///< over free voxels
    double content = 0;
    glm::dvec3 gradient{0};  ///< content per metre
};

/// Interpolated between the free voxels around the point. The gradient is exact for linear fields, at obstacles and
/// sides too: voxels' central differences, one-sided where only one neighbour is free. Zeros outside the domain.
WaterSample sample_water(const WaterGrid& grid, const WaterFaces& faces, const WaterBrick& contents,
                         const glm::dvec3& point);

struct WaterHeading {
    glm::dvec3 heading{0};
    bool clear = false;
};

/// The heading nearest to `pose.heading + direction` along which a segment of `length` is clear: turned by 2, 4, ...
/// 180 degrees, first towards the side where `direction` points. Zero and not clear if there is none.
WaterHeading clear_heading(const WaterGrid& grid, const WaterSolids& solids, const Pose& pose,
                           const glm::dvec3& direction, double length);

}  // namespace espalier::environment
