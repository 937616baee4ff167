// A recorded field over height, or over another axis: soil water over depth.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <span>
#include <string>

namespace espalier::analysis {

/// For every frame that has the field, a row per layer of voxels across the axis ("x", "y" or "z"), the lowest first:
/// step, the axis (of the voxels' centres, m), mean, deviation, minimum, maximum, in the field's unit. Every voxel of
/// the recorded box counts, stones too. Throws UserError for a field that no frame has, naming the nearest.
RecordedTable field_profile(const RecordedRun& run, std::span<const RecordedFrame* const> frames,
                            const std::string& field, const std::string& axis);

}  // namespace espalier::analysis
