#include "environment/shade_field.h"

#include "espalier/base/error.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace espalier {
namespace {

// 2^36 voxels: beyond it even an index of the bricks is too large to be meant.
constexpr double most_voxels = 68719476736.0;

/// Rectangles of equal shade within a brick, each layer kept as the differences of its columns and rows: a rectangle
/// is four numbers however many voxels it covers, and whole numbers add up again without error (Crow 1984, reversed).
class Corners {
public:
    void add(int y, int left, int right, int back, int front, Shade weight) {
        Layer& layer = layers_[static_cast<std::size_t>(y)];
        at(layer, left, back) += weight;
        at(layer, left, front + 1) -= weight;
        at(layer, right + 1, back) -= weight;
        at(layer, right + 1, front + 1) += weight;
    }

    /// Writes every voxel's sum, x slowest and z fastest.
    void sum(Shade* sums) {
        for (int y = 0; y < edge; ++y) {
            Layer& layer = layers_[static_cast<std::size_t>(y)];
            for (int x = 0; x < edge; ++x) {
                Shade row = 0;
                for (int z = 0; z < edge; ++z) {
                    row += at(layer, x, z);
                    const Shade above = x == 0 ? 0 : sums[((x - 1) * edge + y) * edge + z];
                    sums[(x * edge + y) * edge + z] = above + row;
                }
            }
        }
    }

private:
    static constexpr int edge = ShadeField::brick_edge;
    using Layer = std::array<Shade, (edge + 1) * (edge + 1)>;
    static Shade& at(Layer& layer, int x, int z) { return layer[static_cast<std::size_t>(x * (edge + 1) + z)]; }

    std::array<Layer, edge> layers_{};
};

}  // namespace

// Each brick is summed by one thread; sums of whole numbers do not depend on their order.
void ShadeField::rebuild(const ShadeCasts& casts) {
    enclose(casts);
    list_casts_by_brick(casts);
    sums_.resize(bricks() * brick_voxels);
    tbb::parallel_for(std::size_t(0), bricks(), [&](std::size_t brick) { sum_brick(casts, brick); });
}

void ShadeField::enclose(const ShadeCasts& casts) {
    box_ = {};
    for (const ShadeCast& cast : casts.casts()) {
        const VoxelBox bounds = casts.bounds(cast).within(clip_);
        if (!bounds.empty()) box_.add(bounds);
    }
    size_ = {0, 0, 0};
    if (box_.empty()) return;
    if (box_.voxels() > most_voxels) {
        throw RunError(
            fmt::format("the shadows spread over {:.3g} voxels; take larger voxels, or a fixed domain", box_.voxels()));
    }
    first_brick_ = brick_of(box_.lower);
    size_ = brick_of(box_.upper) - first_brick_ + 1;
}

// Calls visit(brick) for every brick the pyramid reaches. Of the layers in a brick the lowest is the widest.
template <class Visit>
void ShadeField::visit_bricks(const ShadeCasts& casts, const ShadeCast& cast, const Visit& visit) const {
    const VoxelBox bounds = casts.bounds(cast).within(clip_);
    if (bounds.empty()) return;
    for (int y = bounds.lower.y >> 3; y <= bounds.upper.y >> 3; ++y) {
        const int width = casts.half_width(cast.apex.y - std::max(y * brick_edge, bounds.lower.y));
        const int left = std::max(cast.apex.x - width, bounds.lower.x) >> 3;
        const int right = std::min(cast.apex.x + width, bounds.upper.x) >> 3;
        const int back = std::max(cast.apex.z - width, bounds.lower.z) >> 3;
        const int front = std::min(cast.apex.z + width, bounds.upper.z) >> 3;
        for (int x = left; x <= right; ++x) {
            for (int z = back; z <= front; ++z) visit(glm::ivec3(x, y, z));
        }
    }
}

// A counting sort of (brick, cast) pairs: count, number the bricks, fill.
void ShadeField::list_casts_by_brick(const ShadeCasts& casts) {
    require_memory(0, 0);
    directory_.resize(size_.x * size_.y * size_.z);
    std::fill(directory_.begin(), directory_.end(), 0);
    for (const ShadeCast& cast : casts.casts()) {
        visit_bricks(casts, cast, [&](const glm::ivec3& brick) { ++directory_[cell(brick)]; });
    }
    number_bricks();
    casts_.resize(casts_end_.empty() ? 0 : casts_end_.back());
    std::vector<std::size_t> next(bricks(), 0);
    for (std::size_t brick = 1; brick < bricks(); ++brick) next[brick] = casts_end_[brick - 1];
    for (std::uint32_t number = 0; number < casts.casts().size(); ++number) {
        visit_bricks(casts, casts.casts()[number], [&](const glm::ivec3& brick) {
            casts_[next[static_cast<std::size_t>(directory_[cell(brick)])]++] = number;
        });
    }
}

// Turns the counts in the directory into numbers of bricks.
void ShadeField::number_bricks() {
    origins_.clear();
    casts_end_.clear();
    std::size_t pairs = 0;
    std::size_t place = 0;
    for (int x = 0; x < static_cast<int>(size_.x); ++x) {
        for (int y = 0; y < static_cast<int>(size_.y); ++y) {
            for (int z = 0; z < static_cast<int>(size_.z); ++z, ++place) {
                const std::int32_t count = directory_[place];
                directory_[place] = count == 0 ? -1 : static_cast<std::int32_t>(origins_.size());
                if (count == 0) continue;
                pairs += static_cast<std::size_t>(count);
                casts_end_.push_back(pairs);
                origins_.push_back((first_brick_ + glm::ivec3(x, y, z)) * brick_edge);
            }
        }
    }
    require_memory(pairs, origins_.size());
}

void ShadeField::require_memory(std::size_t pairs, std::size_t bricks) const {
    // A brick here, and two grids of float made of it.
    const std::size_t bytes = size_.x * size_.y * size_.z * sizeof(std::int32_t) + pairs * sizeof(std::uint32_t) +
                              bricks * brick_voxels * (sizeof(Shade) + 2 * sizeof(float));
    if (bytes <= memory_) return;
    throw RunError(fmt::format("the shade of this step needs {} MiB, but --memory leaves it {} MiB; take larger voxels",
                               bytes >> 20, memory_ >> 20));
}

void ShadeField::sum_brick(const ShadeCasts& casts, std::size_t brick) {
    Corners corners;
    const VoxelBox here = VoxelBox{origins_[brick], origins_[brick] + (brick_edge - 1)}.within(clip_);
    for (std::size_t i = brick == 0 ? 0 : casts_end_[brick - 1]; i < casts_end_[brick]; ++i) {
        const ShadeCast& cast = casts.casts()[casts_[i]];
        const VoxelBox part = casts.bounds(cast).within(here);
        for (int y = part.lower.y; y <= part.upper.y; ++y) {
            const int width = casts.half_width(cast.apex.y - y);
            const int left = std::max(cast.apex.x - width, part.lower.x) - origins_[brick].x;
            const int right = std::min(cast.apex.x + width, part.upper.x) - origins_[brick].x;
            const int back = std::max(cast.apex.z - width, part.lower.z) - origins_[brick].z;
            const int front = std::min(cast.apex.z + width, part.upper.z) - origins_[brick].z;
            if (left > right || back > front) continue;
            corners.add(y - origins_[brick].y, left, right, back, front, casts.weight(cast, cast.apex.y - y));
        }
    }
    corners.sum(sums_.data() + brick * brick_voxels);
}

}  // namespace espalier
