// Shade and light as OpenVDB grids, for other processes, recorders and users. They are brought up to date when they are
// asked for, and then only in the bricks that changed.
#pragma once

#include "espalier/geometry/field.h"

#include "environment/light/shade/leaves.h"
#include "environment/light/shade/light.h"

#include <memory>
#include <string>

namespace espalier::environment {

class ShadeGrids {
public:
    /// Fields will be `name` (light) and `name`.shade.
    ShadeGrids(std::string name, const ShadeRule& rule, const ShadeLattice& lattice);
    ~ShadeGrids();

    /// Provides both fields. `bricks` and `shown`, the voxels a viewer should be shown, are looked at whenever a field
    /// is asked for. Voxels that nothing shades are inactive: full light, no shade.
    void provide(ShadeBricks& bricks, const VoxelBox& shown, Fields& fields);

    /// Grids that nobody has asked for in many steps give their memory back.
    void begin_step(const ShadeBricks& bricks);

    /// The leaf of light of each brick, for a caller that writes all of them now, while the sums are at hand. None if
    /// the light was not asked for since the last time.
    std::span<const ShadeLeaf> light_to_write(ShadeBricks& bricks, const VoxelBox& shown);

private:
    struct Grids;
    void note_changes(ShadeBricks& bricks);

    std::string name_;
    ShadeRule rule_;
    bool light_asked_for_ = false;
    std::unique_ptr<Grids> grids_;
};

}  // namespace espalier::environment
