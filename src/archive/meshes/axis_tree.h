// A frame's axes as trees: which internodes an axis consists of, and which axes stand on which internode.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/archive/recorded_run.h"

#include <vector>

namespace espalier::archive {

struct AxisTree {
    struct Axis {
        std::uint32_t plant;
        std::uint32_t first, end;  ///< internodes
        std::int32_t bearer;       ///< the internode it stands on, or FrameInternode::none
    };

    std::vector<FrameInternode> internodes;
    std::vector<Axis> axes;                              ///< plant after plant, each after the axis it stands on
    std::vector<std::vector<std::uint32_t>> axes_borne;  ///< by each internode

    /// Axes that stand on none, in their order.
    std::vector<std::uint32_t> trunks() const;
};

/// Where branches leave an axis: the ring there stands across the mean of their directions, weighted with their radii
/// (Brzoska 2019, Interaktive Pflanzenmodellierung, figure 29).
struct Fork {
    std::int32_t point;
    glm::vec3 across_of;  ///< unit vector
};

/// Points that one tube follows.
struct AxisPath {
    std::uint32_t plant;
    std::size_t row;  ///< row of `of_cells` of the axis it begins with
    std::vector<std::int32_t> points;
    bool stands_free = true;  ///< on no other axis
    std::vector<Fork> forks = {};
    std::int32_t first_ring = FrameInternode::none;  ///< the fork whose ring it shares; none: it has one of its own
};

/// Axes joined for drawing: where one ends and others begin, the thickest of them goes on, of equals the straightest.
std::vector<AxisPath> axis_paths(const FrameGeometry& geometry, const MeshOptions& options);

/// Returns the tree of the plants asked for.
AxisTree axis_tree(const FrameGeometry& geometry, const MeshOptions& options);

}  // namespace espalier::archive
