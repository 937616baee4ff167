// All shade at once. Along x a row of voxels changes only where a layer of some pyramid begins or ends: a running row
// takes both in, and is what every voxel's sum is copied from. Work grows with the voxels and with the layers of the
// pyramids, not with their volume.
#pragma once

#include "environment/light/shade/leaves.h"

#include <functional>

namespace espalier::environment {

/// The pyramids of one layer of apices, on their way along x. At any x those that a layer q of theirs begins or ends at
/// stand side by side: their apices are half_width(q) away.
struct ShadeFront {
    const ShadeCast* casts;
    const std::uint32_t* first;    ///< by x - base: the first pyramid with its apex there or beyond
    int y;                         ///< height of the apices
    int upper_layer, lower_layer;  ///< the layers q that lie at the heights of the rows
    int nearest, farthest;         ///< their half-widths
};

/// How wide the layers of a pyramid are, and which are so wide.
struct ShadeWidths {
    std::vector<int> wide, deep;  ///< half-widths of each layer along x and z
    std::vector<int>
        first_of_width;  ///< the first layer at least so wide along x; one more entry than there are widths
};

/// The running rows of eight heights, as differences between neighbours along z: a layer of a pyramid is two numbers in
/// its row however wide it is (Crow 1984, reversed).
struct ShadeRows {
    Shade* rows;         ///< one for each of the eight heights, one after the other
    std::size_t length;  ///< length of a row
    int begin;           ///< z of its first voxel
    int lower, upper;    ///< z that may be shaded
    int base;            ///< x that fronts count from
};

/// A brick of the column being written.
struct ShadeTarget {
    Shade* sums;
    std::size_t at;         ///< where its voxels begin in each running row
    ShadeLeaf leaf;         ///< where its light goes, if anywhere
    std::uint64_t all = 0;  ///< bits that any of its sums has
};

class ShadeSweep {
public:
    /// Gives, when bricks are those of this step, the leaf of each that its light is wanted in; or none.
    using Leaves = std::function<std::span<const ShadeLeaf>()>;

    /// Makes `bricks` those that `casts` reach, of which there must be some, and writes every sum. `box`: around them.
    void run(const ShadeCasts& casts, const VoxelBox& box, ShadeBricks& bricks, const Leaves& leaves);
    /// What a run takes for a while: sorted pyramids, where those of each height end, and of each thread running rows
    /// and fronts.
    static std::size_t bytes(const ShadeCasts& casts, const VoxelBox& box);

private:
    /// Pyramids of one slice with apices at one height, sorted along x.
    struct Layer {
        int slice, y;
        std::size_t begin, end;
    };
    /// A stretch of bricks along x in one layer of bricks and one slice, swept by one thread.
    struct Stretch {
        int slice, y, begin, end;
    };

    void measure(const ShadeCasts& casts);
    void sort(const ShadeCasts& casts, const VoxelBox& box, int first_z);
    void list_layers(int first_slice, int least_y, std::size_t heights, std::span<const std::size_t> ends);
    void count(const ShadeCasts& casts, const ShadeBricks& bricks);
    void count_layer(const ShadeCasts& casts, const ShadeBricks& bricks, int y);
    void list_stretches(const ShadeBricks& bricks);
    std::vector<ShadeFront> fronts_of(const ShadeCasts& casts, const Stretch& stretch, int base, int end,
                                      Column<std::uint32_t>& first) const;
    void sweep(const ShadeCasts& casts, const Stretch& stretch, ShadeBricks& bricks) const;
    void list_targets(ShadeBricks& bricks, const glm::ivec3& first, int end_z, std::vector<ShadeTarget>& targets) const;
    /// The layers of a slice whose pyramids may reach heights from `lower` to `upper`.
    std::span<const Layer> layers_over(int slice, int lower, int upper, int depth) const;

    ShadeWidths widths_;
    Column<ShadeCast> sorted_;  ///< once for every slice they reach into
    std::vector<Layer> layers_;
    Column<std::uint32_t> counts_;  ///< pyramids that reach each place of the directory
    std::vector<Stretch> stretches_;
    std::span<const ShadeLeaf> leaves_;  ///< leaves of each brick, during a run
};

/// Bricks of one layer of them, from `left` to `right` along x and from `back` to `front` along z.
struct BrickSquare {
    int left, right, back, front;
};

/// Those that the pyramid reaches in the layer `y` of bricks, which its bounds must do. Of its layers in a brick the
/// lowest is the widest.
inline BrickSquare reached_bricks(const ShadeCasts& casts, const glm::ivec3& apex, int y) {
    const VoxelBox& clip = casts.clip();
    const int q = std::min(casts.rule().depth, apex.y - std::max(y * ShadeBricks::edge, clip.lower.y));
    const int width = casts.half_width(q), deep = casts.thickness(q);
    return {std::max(apex.x - width, clip.lower.x) >> 3, std::min(apex.x + width, clip.upper.x) >> 3,
            std::max(apex.z - deep, clip.lower.z) >> 3, std::min(apex.z + deep, clip.upper.z) >> 3};
}

}  // namespace espalier::environment
