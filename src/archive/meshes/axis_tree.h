// A frame's axes as trees: which internodes an axis consists of, and which axes stand on which internode.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/archive/recorded_run.h"

#include <vector>

namespace espalier::archive {

/// Internodes are numbered anew, without those of plants that were not asked for.
struct AxisTree {
    struct Axis {
        std::uint32_t plant;
        InternodeIndex first, end;
        InternodeIndex bearer;     ///< the internode it stands on, or none
        bool is_unmarked = false;  ///< its first internode is drawn with G
        bool goes_on = false;      ///< with what its bearer is the last internode of, at once or behind a gap
    };
    using AxisIndex = Index<Axis>;

    RowsOf<FrameInternode, FrameInternode> internodes;
    RowsOf<Axis, Axis> axes;  ///< plant after plant, each after the axis it stands on
    RowsOf<FrameInternode, std::vector<AxisIndex>> axes_borne;

    /// Axes that stand on none, in their order.
    std::vector<AxisIndex> trunks() const;
};

/// Where branches leave an axis: the ring there stands across the mean of their directions, weighted with their radii
/// (Brzoska 2019, Interaktive Pflanzenmodellierung, figure 29).
struct Fork {
    PointIndex point;
    glm::vec3 across_of;  ///< unit vector
};

/// Points that one tube follows.
struct AxisPath {
    std::uint32_t plant;
    std::size_t row;  ///< row of `of_cells` of the axis it begins with
    std::vector<PointIndex> points;
    bool stands_free = true;  ///< on no other axis
    std::vector<Fork> forks = {};
    PointIndex first_ring = {};  ///< the fork whose ring it shares; none: it has one of its own
};

/// Axes joined for drawing: where one ends and others begin, the thickest of them goes on, of equals the straightest.
std::vector<AxisPath> axis_paths(const FrameGeometry& geometry, const MeshOptions& options);

/// Returns the tree of the plants asked for.
AxisTree axis_tree(const FrameGeometry& geometry, const MeshOptions& options);

/// Bearers as files that nest axes need them. Axes of one order that begin together stand side by side, on what bears
/// the first of them. An axis of a higher order that begins beside all others hangs by a link on the nearest end of an
/// internode of the axis before it whose order is lower; or it goes on behind a gap, with the last axis of its own
/// order.
void settle_bearers(AxisTree& tree);

}  // namespace espalier::archive
