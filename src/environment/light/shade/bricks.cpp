#include "environment/light/shade/bricks.h"

#include "espalier/base/column.h"
#include "espalier/base/error.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <cstring>
#include <new>

namespace espalier::environment {
namespace {

// Directories up to this many places are given room to grow at every side.
constexpr std::size_t small_directory = 1 << 18;

std::size_t places_of(const glm::ivec3& lower, const glm::ivec3& upper) {
    const glm::tvec3<std::size_t> size(upper - lower + 1);
    return size.x * size.y * size.z;
}

}  // namespace

bool ShadeBricks::covers(const glm::ivec3& lower, const glm::ivec3& upper) const {
    return !directory_.empty() && glm::min(first_, lower) == first_ &&
           glm::max(first_ + glm::ivec3(size_) - 1, upper) == first_ + glm::ivec3(size_) - 1;
}

void ShadeBricks::cover(const glm::ivec3& lower, const glm::ivec3& upper) {
    if (covers(lower, upper) && places() <= std::max(small_directory, 2 * places_of(lower, upper))) return;
    place_directory(lower, upper);
}

bool ShadeBricks::cover_also(const glm::ivec3& lower, const glm::ivec3& upper) {
    if (covers(lower, upper)) return true;
    if (directory_.empty()) return false;
    const glm::ivec3 least = glm::min(first_, lower), most = glm::max(first_ + glm::ivec3(size_) - 1, upper);
    if (places_of(least, most) > small_directory) return false;
    place_directory(least, most);
    return true;
}

void ShadeBricks::place_directory(const glm::ivec3& lower, const glm::ivec3& upper) {
    glm::ivec3 first = lower;
    glm::tvec3<std::size_t> size(upper - lower + 1);
    if (size.x * size.y * size.z <= small_directory) {
        const glm::ivec3 margin = (upper - lower + 1) / 8 + 1;
        first -= margin;
        size += glm::tvec3<std::size_t>(2 * margin);
    }
    require_memory(size.x * size.y * size.z, bricks_.size() - unused_.size());
    first_ = first;
    size_ = size;
    directory_.resize(size.x * size.y * size.z);
    std::fill(directory_.begin(), directory_.end(), none);
    for (std::size_t number = 0; number < end(); ++number) {
        if (!exists(number)) continue;
        if (covers(bricks_[number], bricks_[number])) {
            directory_[place(bricks_[number])] = static_cast<std::int32_t>(number);
        } else {
            mark(number);
            reach_[number] = 0;
            unused_.push_back(static_cast<std::int32_t>(number));
        }
    }
}

std::int32_t ShadeBricks::retain(const glm::ivec3& brick) {
    std::int32_t& number = directory_[place(brick)];
    if (number == none) {
        require_memory(places(), bricks_.size() - unused_.size() + 1);
        number = add(brick);
        std::memset(sums(static_cast<std::size_t>(number)), 0, voxels * sizeof(Shade));
    }
    ++reach_[static_cast<std::size_t>(number)];
    mark(static_cast<std::size_t>(number));
    return number;
}

void ShadeBricks::release(std::int32_t number) {
    mark(static_cast<std::size_t>(number));
    if (--reach_[static_cast<std::size_t>(number)] == 0) remove(number);
}

std::int32_t ShadeBricks::add(const glm::ivec3& brick) {
    if (!unused_.empty()) {
        const std::int32_t number = unused_.back();
        unused_.pop_back();
        bricks_[static_cast<std::size_t>(number)] = brick;
        return number;
    }
    const std::size_t number = end();
    if (number / per_block == blocks_.size()) {
        constexpr std::size_t bytes = per_block * voxels * sizeof(Shade);
        blocks_.emplace_back(static_cast<Shade*>(allocate_huge(bytes)));
    }
    bricks_.push_back(brick);
    reach_.push_back(0);
    marks_.push_back(0);
    return static_cast<std::int32_t>(number);
}

void ShadeBricks::remove(std::int32_t number) {
    directory_[place(bricks_[static_cast<std::size_t>(number)])] = none;
    unused_.push_back(number);
}

void ShadeBricks::clear() {
    for (std::size_t number = 0; number < end(); ++number) {
        if (!exists(number)) continue;
        mark(number);
        reach_[number] = 0;
        remove(static_cast<std::int32_t>(number));
    }
}

void ShadeBricks::set_reach(std::span<const std::uint32_t> counts) {
    std::size_t bricks = 0;
    for (const std::uint32_t count : counts) bricks += count != 0;
    require_memory(places(), bricks);
    for (std::size_t number = 0; number < end(); ++number) {
        if (!exists(number)) continue;
        mark(number);
        reach_[number] = counts[place(bricks_[number])];
        if (reach_[number] == 0) remove(static_cast<std::int32_t>(number));
    }
    const glm::ivec3 size(size_);
    std::size_t place = 0;
    for (int x = 0; x < size.x; ++x) {
        for (int y = 0; y < size.y; ++y) {
            for (int z = 0; z < size.z; ++z, ++place) {
                if (counts[place] == 0 || directory_[place] != none) continue;
                directory_[place] = add(first_ + glm::ivec3(x, y, z));
                const auto number = static_cast<std::size_t>(directory_[place]);
                reach_[number] = counts[place];
                mark(number);
            }
        }
    }
}

void ShadeBricks::forget_changes() {
    for (const std::uint32_t number : changed_) marks_[number] = 0;
    changed_.clear();
}

void ShadeBricks::reserve_bytes(std::size_t bytes) {
    besides_ = bytes;
    require_memory(places(), bricks_.size() - unused_.size());
}

std::size_t ShadeBricks::bytes(std::size_t places, std::size_t bricks) const {
    // A place in the directory and in the counts of a rebuild; a brick here, and two grids of float made of it.
    return besides_ + places * 2 * sizeof(std::int32_t) + bricks * voxels * (sizeof(Shade) + 2 * sizeof(float));
}

void ShadeBricks::require_memory(std::size_t places, std::size_t bricks) const {
    const std::size_t needed = bytes(places, bricks);
    if (needed <= memory_) return;
    throw RunError(fmt::format("the shade of this step needs {} MiB, but --memory leaves it {} MiB; take larger voxels",
                               needed >> 20, memory_ >> 20));
}

}  // namespace espalier::environment
