// The limbs of a step as pictures have them: tubes that run into each other or one smooth skin, with bark.
#pragma once

#include "studio/packets/limb_axes.h"

#include <cstdint>
#include <functional>
#include <string>

namespace espalier::studio {

/// Told which part is done; false: it is not wanted any more.
using ContinueCallback = std::function<bool(double share)>;

struct LimbOrder {
    LimbAxes axes;
    std::uint32_t growth = 0;
    int step = 0;
    bool smooth = false;
};

/// The message `ESM1` of docs/developer/studio-protocol.md; "" if it was not wanted any more. Throws UserError as
/// `skin_voxel` does.
std::string limb_mesh(const LimbOrder& order, const ContinueCallback& may_continue);

}  // namespace espalier::studio
