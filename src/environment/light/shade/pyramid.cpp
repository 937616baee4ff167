#include "environment/light/shade/pyramid.h"

#include "espalier/base/error.h"
#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <bit>

namespace espalier::environment {
namespace {

constexpr double most_shade = 134217728.0;  // 2^27: all pyramids in one voxel still fit into 63 bits

}  // namespace

// A spread such as 0.1 must reach its whole numbers in spite of rounding.
int half_width(const ShadeRule& rule, int q) {
    return static_cast<int>(std::floor(rule.spread * q + 1e-9));
}

void VoxelBox::add(const VoxelBox& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
}

double VoxelBox::voxels() const {
    if (empty()) return 0;
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower) + 1.0;
    return size.x * size.y * size.z;
}

ShadeCasts::ShadeCasts(const ShadeRule& rule, const VoxelBox& clip) : rule_(rule), clip_(clip) {
    for (int q = 0; q <= rule.depth; ++q) {
        half_widths_.push_back(environment::half_width(rule, q));
        fading_.push_back(math::pow(rule.dissipation, -q));
    }
    grow_table();
}

// Palubicki et al. 2009: delta s = a b^-q. Where shadows multiply it lets through 1 - min(1, delta s), kept as an
// optical depth.
double ShadeCasts::shade_of_layer(double s, int q) const {
    const double amount = s * rule_.strength * fading_[static_cast<std::size_t>(q)];
    if (!rule_.attenuate) return amount;
    return amount >= 1 ? opaque_depth : std::min(opaque_depth, -math::log1p(-amount));
}

void ShadeCasts::begin_step() {
    std::swap(casts_, before_);
    casts_.clear();
    total_ = 0;
    // Strengths that differ in every step must not pile up.
    if (strengths_.size() <= 2 * before_.size() + 1024) return;
    before_.clear();
    strengths_.clear();
    darkest_.clear();
    layers_.clear();
    table_.clear();
    grow_table();
}

void ShadeCasts::add(const glm::ivec3& apex, double s) {
    const std::uint32_t number = row_of(s);
    total_ += darkest_[number];
    if (!(total_ < most_shade)) {
        throw RunError(fmt::format("the shadows of this step add up to more than {:.0f}", most_shade));
    }
    if (bounds(apex).within(clip_).empty()) return;
    casts_.push_back({apex, number * static_cast<std::uint32_t>(rule_.depth + 1)});
}

std::size_t ShadeCasts::bytes() const {
    return (casts_.capacity() + before_.capacity()) * sizeof(ShadeCast) + layers_.capacity() * sizeof(Shade) +
           (strengths_.capacity() + darkest_.capacity()) * sizeof(double) + table_.capacity() * sizeof(std::uint32_t);
}

// The number of the strength's row.
std::uint32_t ShadeCasts::row_of(double s) {
    if (last_ < strengths_.size() && strengths_[last_] == s) return last_;
    const std::size_t mask = table_.size() - 1;
    std::size_t place = mix(std::bit_cast<std::uint64_t>(s)) & mask;
    for (; table_[place] != 0; place = (place + 1) & mask) {
        if (strengths_[table_[place] - 1] == s) return last_ = table_[place] - 1;
    }
    last_ = add_row(s);
    table_[place] = last_ + 1;
    if (2 * strengths_.size() > table_.size()) grow_table();
    return last_;
}

std::uint32_t ShadeCasts::add_row(double s) {
    const double darkest = shade_of_layer(s, 0);
    if (layers_.size() + static_cast<std::size_t>(rule_.depth) >= std::numeric_limits<std::uint32_t>::max()) {
        throw RunError("more shadows of different strengths than can be numbered");
    }
    if (!(darkest < most_shade)) {
        throw RunError(fmt::format("the shadows of this step add up to more than {:.0f}", most_shade));
    }
    for (int q = 0; q <= rule_.depth; ++q) {
        layers_.push_back(std::llround(shade_of_layer(s, q) * shade_steps_per_unit));
    }
    strengths_.push_back(s);
    darkest_.push_back(darkest);
    return static_cast<std::uint32_t>(strengths_.size() - 1);
}

void ShadeCasts::grow_table() {
    table_.assign(std::bit_ceil(4 * strengths_.size() + 16), 0);
    const std::size_t mask = table_.size() - 1;
    for (std::uint32_t number = 0; number < strengths_.size(); ++number) {
        std::size_t place = mix(std::bit_cast<std::uint64_t>(strengths_[number])) & mask;
        while (table_[place] != 0) place = (place + 1) & mask;
        table_[place] = number + 1;
    }
}

}  // namespace espalier::environment
