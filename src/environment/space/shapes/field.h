// A shape sampled onto an OpenVDB level set, for recorders and users.
#pragma once

#include "espalier/environment/shape.h"
#include "espalier/geometry/field.h"

namespace espalier::environment {

/// The narrow-band level set of `shape` within `box`; voxels farther than the band hold its width with the right sign.
/// Throws UserError at `place` if it would take more than `memory` bytes.
std::shared_ptr<const FieldGrid> sample_level_set(const Shape& shape, const Box& box, double voxel, std::size_t memory,
                                                  const Place& place);

}  // namespace espalier::environment
