// Where shade is kept: bricks of 8 x 8 x 8 voxels laid out as OpenVDB's leaves, each with the number of pyramids that
// reach it. A brick exists as long as one does.
#pragma once

#include "environment/light/shade/pyramid.h"

#include <cstddef>
#include <memory>

namespace espalier::environment {

class ShadeBricks {
public:
    static constexpr int edge = 8;
    static constexpr std::size_t voxels = 512;
    static constexpr std::int32_t none = -1;

    /// `memory`: bytes that bricks, grids made of them, and what is kept besides may take.
    explicit ShadeBricks(std::size_t memory) : memory_(memory) {}

    /// What bricks and what is kept besides take. Without the directory, whose size tells where bricks have been: a
    /// world that goes on from a checkpoint would count other bytes.
    std::size_t bytes() const { return bytes(0, bricks_.size() - unused_.size()); }
    void limit_memory(std::size_t bytes) { memory_ = bytes; }
    /// So many bytes are, or soon will be, kept besides the bricks. Throws RunError if they do not fit beside them.
    void reserve_bytes(std::size_t bytes);

    static glm::ivec3 brick_of(const glm::ivec3& voxel) { return {voxel.x >> 3, voxel.y >> 3, voxel.z >> 3}; }
    static std::size_t offset(const glm::ivec3& v) {
        return static_cast<std::size_t>((v.x & 7) << 6 | (v.y & 7) << 3 | (v.z & 7));
    }

    /// Makes room for bricks from `lower` to `upper`, and forgets bricks elsewhere where that saves much memory.
    /// Throws RunError before allocating more than the memory allows.
    void cover(const glm::ivec3& lower, const glm::ivec3& upper);
    /// Makes room besides all bricks there are; false if that is a matter for `cover`.
    bool cover_also(const glm::ivec3& lower, const glm::ivec3& upper);
    /// All places that there is room for, z fastest.
    const glm::ivec3& first() const { return first_; }
    const glm::tvec3<std::size_t>& size() const { return size_; }
    std::size_t places() const { return directory_.size(); }

    /// The number of the brick at a place, or none. Numbers are reused when bricks go.
    std::int32_t find(const glm::ivec3& brick) const {
        const glm::tvec3<std::size_t> at(brick - first_);  // what lies below the first is huge
        return at.x < size_.x && at.y < size_.y && at.z < size_.z ? directory_[place(brick)] : none;
    }
    std::size_t place(const glm::ivec3& brick) const {
        const glm::ivec3 at = brick - first_;
        return (std::size_t(at.x) * size_.y + std::size_t(at.y)) * size_.z + std::size_t(at.z);
    }

    /// One more than the highest number.
    std::size_t end() const { return reach_.size(); }
    bool exists(std::size_t number) const { return reach_[number] != 0; }
    const glm::ivec3& brick(std::size_t number) const { return bricks_[number]; }
    Shade* sums(std::size_t number) { return blocks_[number / per_block].get() + number % per_block * voxels; }
    const Shade* sums(std::size_t number) const {
        return blocks_[number / per_block].get() + number % per_block * voxels;
    }

    /// One pyramid more reaches this brick, which there must be room for; a new brick is all 0.
    std::int32_t retain(const glm::ivec3& brick);
    /// One pyramid less; the last leaves it all 0.
    void release(std::int32_t number);
    /// No pyramid reaches any brick.
    void clear();
    /// As many pyramids reach each place as `counts` says. The sums of all bricks are then unknown.
    void set_reach(std::span<const std::uint32_t> counts);

    /// Bricks whose sums, or whose existence, changed since the last `forget_changes`.
    std::span<const std::uint32_t> changed() const { return changed_; }
    void mark(std::size_t number) {
        if (marks_[number]) return;
        marks_[number] = 1;
        changed_.push_back(static_cast<std::uint32_t>(number));
    }
    void forget_changes();

private:
    // 2 MiB, a huge page where the system has them: neighbouring bricks are looked up without a miss of the page table.
    static constexpr std::size_t per_block = 512;
    struct Free {
        void operator()(Shade* block) const { free_huge(block); }
    };

    bool covers(const glm::ivec3& lower, const glm::ivec3& upper) const;
    void place_directory(const glm::ivec3& lower, const glm::ivec3& upper);
    std::int32_t add(const glm::ivec3& brick);
    void remove(std::int32_t number);
    std::size_t bytes(std::size_t places, std::size_t bricks) const;
    void require_memory(std::size_t places, std::size_t bricks) const;

    std::size_t memory_, besides_ = 0;
    glm::ivec3 first_{0};
    glm::tvec3<std::size_t> size_{0};
    Column<std::int32_t> directory_;
    std::vector<std::unique_ptr<Shade[], Free>> blocks_;
    std::vector<glm::ivec3> bricks_;    ///< place of each brick, in bricks
    std::vector<std::uint32_t> reach_;  ///< pyramids that reach it
    std::vector<std::int32_t> unused_;  ///< numbers of bricks that went
    std::vector<std::uint32_t> changed_;
    std::vector<std::uint8_t> marks_;
};

}  // namespace espalier::environment
