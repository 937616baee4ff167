// The shade of all pyramids of a step: what changed since the last one is added and taken away, or all is summed again,
// whichever is less work. Sums of whole numbers: both come to the same.
#pragma once

#include "environment/light/shade/bricks.h"
#include "environment/light/shade/pyramid.h"
#include "environment/light/shade/sweep.h"

#include <cstddef>

namespace espalier::environment {

/// What changed between the pyramids of two steps.
struct ShadeChanges {
    std::vector<ShadeCast> gone, come;
};

/// Leaves in `changes` pyramids that are only in `before` or only in `now`, perhaps with some that are in both: lists
/// are read once, side by side, for a plant keeps the order of its organs. False if there are more than `most`.
bool find_changes(std::span<const ShadeCast> before, std::span<const ShadeCast> now, std::size_t most,
                  ShadeChanges& changes);

/// The part of a square that lies in a brick: rows from `left` to `right`, of each the voxels from `back` to `front`.
struct ShadePart {
    Shade* layer;
    int left, right, back, front;
    Shade weight;
};

class ShadeField {
public:
    /// `memory`: bytes that bricks, and grids made of them, may take.
    explicit ShadeField(std::size_t memory) : bricks_(memory) {}

    /// Comes to be the sum of this step's pyramids; it must have been asked for that of the step before. False if
    /// nothing changed. What is summed again is written into `leaves` as well. Throws RunError before allocating more
    /// than the memory allows.
    bool show(const ShadeCasts& casts, const ShadeSweep::Leaves& leaves = {});
    /// The sum of all pyramids, whatever was before.
    void rebuild(const ShadeCasts& casts, const ShadeSweep::Leaves& leaves = {});
    /// Takes the changes in, which lead to this step's pyramids. False, and nothing done, where only a rebuild can.
    bool update(const ShadeCasts& casts, const ShadeChanges& changes);

    Shade at(const glm::ivec3& voxel) const {
        const std::int32_t brick = bricks_.find(ShadeBricks::brick_of(voxel));
        return brick < 0 ? 0 : bricks_.sums(static_cast<std::size_t>(brick))[ShadeBricks::offset(voxel)];
    }

    const VoxelBox& box() const { return box_; }  ///< around all pyramids
    ShadeBricks& bricks() { return bricks_; }
    const ShadeBricks& bricks() const { return bricks_; }

private:
    /// The outermost apices, and how many pyramids have each of them.
    struct Extremes {
        glm::ivec3 lower{std::numeric_limits<int>::max()}, upper{std::numeric_limits<int>::min()};
        glm::ivec3 at_lower{0}, at_upper{0};

        void add(const glm::ivec3& apex);
        /// False if no pyramid is known any more to be outermost.
        bool remove(const glm::ivec3& apex);
    };

    void enclose(const ShadeCasts& casts, const Extremes& extremes);
    static Extremes extremes_of(std::span<const ShadeCast> casts);
    void add(const ShadeCasts& casts, std::span<const ShadeCast> some, std::span<const ShadeCast> others, Shade sign);
    void list(const ShadeCasts& casts, const ShadeCast& cast, const ShadeCast* except, Shade sign);
    void add_listed();

    ShadeBricks bricks_;
    ShadeSweep sweep_;
    ShadeChanges changes_;
    std::vector<ShadePart> parts_;
    Extremes extremes_;
    VoxelBox box_;
    std::size_t shown_ = 0;  ///< pyramids
};

}  // namespace espalier::environment
