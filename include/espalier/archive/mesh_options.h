// How a recorded frame becomes triangles.
#pragma once

#include "espalier/base/stations.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace espalier::archive {

/// How thick axes join: as tubes that run into each other, or as one smooth surface.
struct AxisSkin {
    bool smooth = false;
    double blend = 1.5;      ///< radius of the fillet between two axes, in radii of the thinner; 0: sharp joints
    double voxel = 0;        ///< metres between vertices; 0: chosen. Axes thinner than 1.5 voxels stay tubes
    bool displaced = false;  ///< the relief of bark moves the vertices; otherwise light alone sees it
    std::filesystem::path folder{};  ///< where files of bark may lie that are not where their names say
};

struct MeshOptions {
    int sides = 8;        ///< corners around a tube; 3 at least
    double simplify = 0;  ///< metres that a tube's middle line and radius may stray; 0: every node stays
    std::optional<std::size_t> triangles =
        std::nullopt;  ///< most triangles of tubes and surfaces together; fewer are left as they are
    double distance =
        0;          ///< metres from which it is seen: what is smaller than a thousandth of it is left out; 0: nothing
    char up = 'y';  ///< or 'z'
    std::optional<std::uint32_t> plant = std::nullopt;  ///< its number; none: all plants
    AxisSkin skin = {};
};

}  // namespace espalier::archive
