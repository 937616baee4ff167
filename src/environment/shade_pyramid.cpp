#include "environment/shade_pyramid.h"

#include "espalier/base/error.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace espalier {
namespace {

constexpr double steps_per_unit = 68719476736.0;  // 2^36
constexpr double most_shade = 134217728.0;        // 2^27: all pyramids in one voxel still fit into 63 bits
constexpr double opaque = 64;                     // an optical depth nothing comes through: e^-64 = 1.6e-28

}  // namespace

// Palubicki et al. 2009: delta s = a b^-q.
double shade_of_layer(const ShadeRule& rule, double s, int q) {
    const double amount = s * rule.strength * std::pow(rule.dissipation, -q);
    if (!rule.attenuate) return amount;
    return amount >= 1 ? opaque : std::min(opaque, -std::log1p(-amount));
}

// A spread such as 0.1 must reach its whole numbers in spite of rounding.
int half_width(const ShadeRule& rule, int q) {
    return static_cast<int>(std::floor(rule.spread * q + 1e-9));
}

double shade_value(Shade shade) {
    return static_cast<double>(shade) / steps_per_unit;
}

double light_under(const ShadeRule& rule, Shade shade) {
    const double amount = shade_value(shade);
    if (!rule.attenuate) return std::max(rule.full_light - amount, 0.0);
    return amount >= opaque ? 0 : rule.full_light * std::exp(-amount);
}

void VoxelBox::add(const VoxelBox& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
}

VoxelBox VoxelBox::within(const VoxelBox& other) const {
    return {glm::max(lower, other.lower), glm::min(upper, other.upper)};
}

double VoxelBox::voxels() const {
    if (empty()) return 0;
    const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower) + 1.0;
    return size.x * size.y * size.z;
}

std::vector<int> ShadeCasts::widths(const ShadeRule& rule) {
    std::vector<int> all;
    for (int q = 0; q <= rule.depth; ++q) all.push_back(espalier::half_width(rule, q));
    return all;
}

void ShadeCasts::clear() {
    casts_.clear();
    layers_.clear();
    total_ = 0;
}

void ShadeCasts::add(const glm::ivec3& apex, double s) {
    const double darkest = shade_of_layer(rule_, s, 0);
    total_ += darkest;
    if (!(total_ < most_shade)) {
        throw RunError(fmt::format("the shadows of this step add up to more than {:.0f}", most_shade));
    }
    const auto layers = static_cast<std::size_t>(rule_.depth) + 1;
    if (casts_.empty() || s != last_strength_) {
        for (int q = 0; q <= rule_.depth; ++q) {
            layers_.push_back(std::llround(shade_of_layer(rule_, s, q) * steps_per_unit));
        }
        last_strength_ = s;
    }
    casts_.push_back({apex, static_cast<std::uint32_t>(layers_.size() - layers)});
}

Shade ShadeCasts::at(const ShadeCast& cast, const glm::ivec3& voxel) const {
    const int q = cast.apex.y - voxel.y;
    if (q < 0 || q > rule_.depth) return 0;
    const int width = half_width(q);
    if (std::abs(voxel.x - cast.apex.x) > width || std::abs(voxel.z - cast.apex.z) > (rule_.flat ? 0 : width)) return 0;
    return weight(cast, q);
}

VoxelBox ShadeCasts::bounds(const ShadeCast& cast) const {
    const int width = half_width(rule_.depth);
    const int thickness = rule_.flat ? 0 : width;
    return {cast.apex - glm::ivec3(width, rule_.depth, thickness), cast.apex + glm::ivec3(width, 0, thickness)};
}

}  // namespace espalier
