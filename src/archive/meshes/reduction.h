// Fewer triangles with the least change of shape: coarser tubes and organs first, then fewer of them.
#pragma once

#include "archive/meshes/surface_mesh.h"
#include "archive/meshes/tubes.h"

#include <vector>

namespace espalier::archive {

/// A tube that is still to be swept. No sides: it is left out.
struct PlannedTube {
    TubeLine line;
    int sides;
    Caps caps;
    std::size_t row;  ///< of `of_cells`: of the axis it begins with
};

/// Leaves out middles of caps, nodes, sides, vertices of organs and at last thin tubes and whole organs, always where
/// the shape moves by the fewest metres, until `triangles` are left, or a few per cent less. Of organs that look alike,
/// those that stay grow by the area of those that went, up to twice their length (Cook et al. 2007).
void reduce(std::vector<PlannedTube>& tubes, FrameMesh& organs, const RecordedAttributes& of_points,
            std::size_t triangles);

}  // namespace espalier::archive
