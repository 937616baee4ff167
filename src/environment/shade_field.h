// The shade of all pyramids, in bricks of 8 x 8 x 8 voxels laid out as OpenVDB's leaves. Only bricks that something
// shades exist.
#pragma once

#include "environment/shade_pyramid.h"

#include <cstddef>

namespace espalier {

class ShadeField {
public:
    static constexpr int brick_edge = 8;
    static constexpr std::size_t brick_voxels = 512;

    /// `clip`: the voxels there are. `memory`: bytes that bricks, and grids made of them, may take.
    ShadeField(const VoxelBox& clip, std::size_t memory) : clip_(clip), memory_(memory) {}

    /// The sum of all pyramids. Throws RunError before allocating more than the memory allows.
    void rebuild(const ShadeCasts& casts);

    Shade at(const glm::ivec3& voxel) const {
        if (!box_.has(voxel)) return 0;
        const std::int32_t brick = directory_[cell(brick_of(voxel))];
        return brick < 0 ? 0 : sums_[static_cast<std::size_t>(brick) * brick_voxels + offset(voxel)];
    }

    const VoxelBox& clip() const { return clip_; }
    const VoxelBox& box() const { return box_; }  ///< around all pyramids
    std::size_t bricks() const { return origins_.size(); }
    const glm::ivec3& origin(std::size_t brick) const { return origins_[brick]; }
    std::span<const Shade> sums(std::size_t brick) const { return {&sums_[brick * brick_voxels], brick_voxels}; }

private:
    static glm::ivec3 brick_of(const glm::ivec3& voxel) { return {voxel.x >> 3, voxel.y >> 3, voxel.z >> 3}; }
    static std::size_t offset(const glm::ivec3& v) {
        return static_cast<std::size_t>((v.x & 7) << 6 | (v.y & 7) << 3 | (v.z & 7));
    }
    std::size_t cell(const glm::ivec3& brick) const {
        const glm::ivec3 at = brick - first_brick_;
        return (static_cast<std::size_t>(at.x) * size_.y + static_cast<std::size_t>(at.y)) * size_.z +
               static_cast<std::size_t>(at.z);
    }
    template <class Visit>
    void visit_bricks(const ShadeCasts& casts, const ShadeCast& cast, const Visit& visit) const;
    void enclose(const ShadeCasts& casts);
    void list_casts_by_brick(const ShadeCasts& casts);
    void number_bricks();
    void sum_brick(const ShadeCasts& casts, std::size_t brick);
    void require_memory(std::size_t pairs, std::size_t bricks) const;

    VoxelBox clip_, box_;
    std::size_t memory_;
    glm::ivec3 first_brick_{0};
    glm::tvec3<std::size_t> size_{0};     ///< of the directory, in bricks
    Column<std::int32_t> directory_;      ///< number of the brick at each place, -1: none
    std::vector<glm::ivec3> origins_;     ///< of each brick
    Column<std::uint32_t> casts_;         ///< the casts that reach brick 0, then those of brick 1, ...
    std::vector<std::size_t> casts_end_;  ///< where each brick's casts end
    Column<Shade> sums_;
};

}  // namespace espalier
