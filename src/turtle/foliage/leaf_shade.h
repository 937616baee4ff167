// Fewer leaves where others stand above them.
#pragma once

#include "turtle/foliage/bearing_nodes.h"

namespace espalier::turtle {

struct LeafShade {
    double extinction;
    double size;  ///< side of a leaf, m
    double area;  ///< mean area of a leaf, one side, m2
};

/// Leaves of each node, from the highest down, fall to exp(-extinction L), where L is the area of the leaves kept above
/// it by the area of the column of four leaf sizes that it stands in: light under leaves (Monsi & Saeki 1953).
void thin_in_shade(std::vector<std::uint32_t>& counts, const std::vector<BearingNode>& nodes,
                   const PlantGeometry& geometry, const LeafShade& shade, RandomKey key);

}  // namespace espalier::turtle
