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
    std::size_t row;  ///< row of `of_cells` of the axis it begins with
};

/// A thousandth of a distance: what lies closer together there looks like one thing.
inline constexpr double smallest_angle = 1e-3;

/// Leaves out middles of caps, nodes, sides, vertices of organs, thin tubes and whole organs, always where the outline
/// changes by the smallest area for a triangle, until `triangles` are left, or a few per cent less. An axis goes after
/// all axes on it, and keeps its foot and its course as long as it bears some. The organs on an axis, and on all that
/// it bears, count as its own, or they would hang in the air: trunk and limbs stay while there are leaves to see, twigs
/// go before theirs. Of organs that look alike, those that stay grow by the area of those that went, up to twice their
/// length (Cook et al. 2007). `up`: the vertical of the organs; that of the tubes is y.
void reduce(std::vector<PlannedTube>& tubes, FrameMesh& organs, const FrameAttributes& of_points, std::size_t triangles,
            char up = 'y');

/// What looks the same from afar, after the degradation of Weber & Penn 1995 with the range: every change that `reduce`
/// knows is made if the shape moves by no more than `tolerance` metres. Stems no thicker than that are lines: flat
/// tubes of two sides and four triangles a piece. Leaves become fewer, and those that stay grow by the area of all that
/// went. The larger the tolerance, the fewer the triangles.
void degrade(std::vector<PlannedTube>& tubes, FrameMesh& organs, const FrameAttributes& of_points, double tolerance);

}  // namespace espalier::archive
