// The crown of a plant as a body: its extents, its hull, the voxels it fills, which side it leans to.
#pragma once

#include "analysis/branch_tree.h"
#include "analysis/leaves.h"

namespace espalier::analysis {

/// The crown is the leaves and the internodes above the first fork; a plant that has neither is its own crown. What
/// lies below the foot of a plant that rises above it is its roots, which are no part of the crown and make no fork of
/// it.
struct Crown {
    double base = 0, top = 0;         ///< heights of its lowest and highest point above the plant's foot, m
    double width_x = 0, width_z = 0;  ///< extents, m
    double volume = 0;                ///< volume of its convex hull, m3
    double projection = 0;            ///< area of the convex hull of its shadow from straight above, m2
    double voxel = 0;                 ///< edge of the voxels: as given, or 1/32 of its largest extent, m
    double occupied = 0;              ///< volume of the voxels that hold a corner of a leaf or a piece of a branch, m3
    double asymmetry_x = 0, asymmetry_z = 0;  ///< (leaves beyond the foot - leaves before it) / all; tips if no leaves
};

/// The foot is where the plant's first internode begins. `voxel` 0: chosen.
Crown measure_crown(const BranchTree& tree, const Leaves& leaves, double voxel = 0);

}  // namespace espalier::analysis
