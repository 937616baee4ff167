// The state that diffusion settles at: a sparse linear system instead of many steps.
#pragma once

#include "environment/soil/grid/grid.h"
#include "environment/soil/linear/diffusion.h"

#include <cstdint>
#include <vector>

namespace espalier::environment {

/// What does not change by diffusion, per cell: voxels held at their content, and what sources bring per time unit.
struct WaterForcing {
    std::vector<std::uint8_t> held;
    std::vector<double> gain;
};

/// Bytes the system takes per voxel, about.
inline constexpr double steady_bytes_per_voxel = 250;

/// Replaces `contents` by the solution of div(D grad c) + gain = 0. A part of the soil that neither a side nor a held
/// voxel reaches settles at its mean. Throws UserError if such a part gains water: it never settles.
void settle(const WaterGrid& grid, const WaterFaces& faces, const WaterDiffusion& diffusion,
            const WaterForcing& forcing, WaterBrick& contents);

}  // namespace espalier::environment
