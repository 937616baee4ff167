// What a scene says about the soil of any process: where it lies, what stands in it, how it answers queries.
#pragma once

#include "espalier/environment/environment_process.h"
#include "espalier/environment/shape.h"

#include "environment/soil/grid/grid.h"

#include <memory>
#include <string>
#include <vector>

namespace espalier::environment {

/// Domain, voxels, and the solids that nothing passes.
struct SoilSpace {
    Box domain;
    double voxel = 0;
    bool flat = false;  ///< two-dimensional
    std::vector<std::shared_ptr<const Shape>> obstacles;
    std::string obstacle_field, container_field;  ///< distance fields of other processes; empty: none
    Place place, voxel_place;

    /// Throws UserError.
    static SoilSpace read(const Settings& settings, const EnvironmentContext& context);
    WaterGrid grid() const { return {domain, voxel, flat}; }
    /// The same for a process that takes so many bytes a voxel. Throws UserError where it may not take as many.
    WaterGrid affordable_grid(const EnvironmentContext& context, double bytes_per_voxel) const;
};

/// How water is sensed and taken.
struct SoilQuerying {
    bool depletion = true;
    double amount = 1;  ///< amount of one voxel full of content 1
    double range = 1;
    double gradient_length = 0;
    Place amount_place;

    /// Throws UserError.
    static SoilQuerying read(const Settings& settings, double voxel, bool depletion = true);
    const char* unit() const { return amount == 1 ? "voxels" : "m3"; }
};

/// Heights of a layer, m: the keys bottom and top. Throws UserError where they do not rise.
struct LayerHeights {
    double bottom = 0, top = 0;
    static LayerHeights read(const Settings& table, double bottom, double top);
};

/// The cells of the voxels whose centres are in a source. Throws UserError if there are none.
std::vector<std::size_t> cells_of_source(const WaterGrid& grid, const Shape& shape, const Place& place);

}  // namespace espalier::environment
