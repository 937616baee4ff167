// The pieces of a frame as one.
#pragma once

#include "espalier/geometry/frame_geometry.h"

#include <vector>

namespace espalier::archive {

/// Pieces of one frame in their order, of a timeline that numbers symbols and textures alike in all of them. Throws
/// UserError if they have more points than indices can count.
FrameGeometry joined(std::vector<FrameGeometry> pieces);

}  // namespace espalier::archive
