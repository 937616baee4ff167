#include "analysis/voxels.h"

#include <algorithm>
#include <cmath>

namespace espalier::analysis {
namespace {

constexpr std::int64_t most_boxes = std::int64_t{1} << 21;

// Two zero bits in front of every bit.
std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001F00000000FFFF;
    bits = (bits | bits << 16) & 0x001F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    return bits;
}

}  // namespace

glm::i64vec3 VoxelSet::box_of(const glm::dvec3& point) const {
    glm::i64vec3 box;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = std::floor((point[axis] - origin_[axis]) / edge_);
        box[axis] = static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(most_boxes - 1)));
    }
    return box;
}

void VoxelSet::add(const glm::i64vec3& box) {
    const std::uint64_t code = spread(static_cast<std::uint64_t>(box.x)) |
                               spread(static_cast<std::uint64_t>(box.y)) << 1 |
                               spread(static_cast<std::uint64_t>(box.z)) << 2;
    // Neighbouring internodes often share a box.
    if (codes_.size() > unique_ && codes_.back() == code) return;
    if (codes_.size() > 2 * unique_ + (std::size_t{1} << 22)) remove_repeated();
    codes_.push_back(code);
}

void VoxelSet::add_point(const glm::dvec3& point) {
    add(box_of(point));
}

void VoxelSet::add_segment(const glm::dvec3& from, const glm::dvec3& to) {
    glm::i64vec3 box = box_of(from);
    const glm::i64vec3 last = box_of(to);
    const glm::dvec3 way = to - from;
    glm::dvec3 next,
        between;  // where the segment, 0 to 1, enters its next box along each axis; how far apart those are
    glm::i64vec3 step;
    std::int64_t steps = 0;
    for (int axis = 0; axis < 3; ++axis) {
        step[axis] = last[axis] > box[axis] ? 1 : -1;
        steps += std::abs(last[axis] - box[axis]);
        const double wall = origin_[axis] + static_cast<double>(box[axis] + (step[axis] > 0)) * edge_;
        next[axis] = box[axis] == last[axis] ? 2 : (wall - from[axis]) / way[axis];
        between[axis] = way[axis] == 0 ? 0 : edge_ / std::abs(way[axis]);
    }
    add(box);
    // As many walls are crossed as the boxes of both ends are apart, whatever rounding does to their order.
    for (; steps > 0; --steps) {
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        box[axis] += step[axis];
        next[axis] = box[axis] == last[axis] ? 2 : next[axis] + between[axis];
        add(box);
    }
}

void VoxelSet::remove_repeated() {
    if (codes_.size() == unique_) return;
    std::sort(codes_.begin() + static_cast<std::ptrdiff_t>(unique_), codes_.end());
    std::inplace_merge(codes_.begin(), codes_.begin() + static_cast<std::ptrdiff_t>(unique_), codes_.end());
    codes_.erase(std::unique(codes_.begin(), codes_.end()), codes_.end());
    unique_ = codes_.size();
}

std::size_t VoxelSet::count() {
    remove_repeated();
    return codes_.size();
}

void VoxelSet::coarsen() {
    remove_repeated();
    for (std::uint64_t& code : codes_) code >>= 3;
    codes_.erase(std::unique(codes_.begin(), codes_.end()), codes_.end());
    unique_ = codes_.size();
    edge_ *= 2;
}

}  // namespace espalier::analysis
