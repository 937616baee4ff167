// How uptake is shared when many modules take water from the same voxels.
#pragma once

#include "environment/soil/grid/grid.h"

#include <span>
#include <vector>

namespace espalier::environment {

/// One wish, in content times voxels, spread over the voxels of a stencil.
struct WaterWish {
    WaterStencil stencil;  ///< weights over free voxels; all 0 obtains nothing
    double amount = 0;
};

struct ShareResult {
    std::vector<double> obtained;  ///< by wish, in content times voxels
    double taken = 0;              ///< out of all voxels
};

/// Wishes that together exceed a voxel's content share it in proportion; the order of the wishes makes no difference to
/// any bit of the result. Contents never fall below 0.
ShareResult share_water(const WaterGrid& grid, std::span<const WaterWish> wishes, WaterBrick& contents);

/// What each wish would obtain alone; nothing is taken.
ShareResult lend_water(const WaterGrid& grid, std::span<const WaterWish> wishes, const WaterBrick& contents);

}  // namespace espalier::environment
