// Shadow pyramids (Palubicki et al. 2009): what one organ takes away from the light below it, as whole numbers, so that
// sums are exact whatever their order.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/math.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

namespace espalier::environment {

/// Shade in steps of 2^-36: added strength, or optical depth where shadows multiply.
using Shade = std::int64_t;

struct ShadeRule {
    bool attenuate = false;
    double strength = 0.2;   ///< a
    double dissipation = 2;  ///< b
    int depth = 6;           ///< q_max: layers below the caster's own
    double spread = 1;       ///< voxels of half-width gained per layer
    double full_light = 1;   ///< C
    bool flat = false;       ///< one voxel thick
};

constexpr double shade_steps_per_unit = 68719476736.0;  // 2^36
constexpr double opaque_depth = 64;                     ///< an optical depth nothing comes through: e^-64 = 1.6e-28

/// The square's half-width in layer q: floor(spread q).
int half_width(const ShadeRule& rule, int q);

inline double shade_value(Shade shade) {
    return static_cast<double>(shade) / shade_steps_per_unit;
}

/// Full light less the shade, or damped by it.
inline double light_under(const ShadeRule& rule, Shade shade) {
    const double amount = shade_value(shade);
    if (!rule.attenuate) return std::max(rule.full_light - amount, 0.0);
    return amount >= opaque_depth ? 0 : rule.full_light * math::exp(-amount);
}

/// Voxels from `lower` to `upper`, both included.
struct VoxelBox {
    glm::ivec3 lower{std::numeric_limits<int>::max()};
    glm::ivec3 upper{std::numeric_limits<int>::min()};

    bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
    bool has(const glm::ivec3& v) const {
        return v.x >= lower.x && v.y >= lower.y && v.z >= lower.z && v.x <= upper.x && v.y <= upper.y && v.z <= upper.z;
    }
    void add(const VoxelBox& other);
    VoxelBox within(const VoxelBox& other) const {
        return {{std::max(lower.x, other.lower.x), std::max(lower.y, other.lower.y), std::max(lower.z, other.lower.z)},
                {std::min(upper.x, other.upper.x), std::min(upper.y, other.upper.y), std::min(upper.z, other.upper.z)}};
    }
    double voxels() const;

    friend bool operator==(const VoxelBox&, const VoxelBox&) = default;
};

/// One pyramid: its apex, and where in ShadeCasts::layers its weights begin.
struct ShadeCast {
    glm::ivec3 apex;
    std::uint32_t row;

    friend bool operator==(const ShadeCast&, const ShadeCast&) = default;
};

/// The pyramids of this step and of the one before. Equal strengths share a row of weights through all steps, so that
/// equal pyramids of two steps are equal as bytes.
class ShadeCasts {
public:
    ShadeCasts(const ShadeRule& rule, const VoxelBox& clip);

    /// This step's pyramids become those of the step before.
    void begin_step();
    /// A pyramid that misses the clip is only counted. Throws RunError where sums would overflow.
    void add(const glm::ivec3& apex, double s);

    std::span<const ShadeCast> casts() const { return casts_; }
    /// Those of the step before; none if their weights are forgotten.
    std::span<const ShadeCast> before() const { return before_; }

    /// The weights of all strengths; those of a pyramid begin at its row, one for each layer.
    const Shade* layers() const { return layers_.data(); }
    const Shade* weights(const ShadeCast& cast) const { return layers() + cast.row; }
    /// What `cast` adds to `voxel`.
    Shade at(const ShadeCast& cast, const glm::ivec3& voxel) const {
        const int q = cast.apex.y - voxel.y;
        if (q < 0 || q > rule_.depth) return 0;
        const int width = half_width(q);
        if (std::abs(voxel.x - cast.apex.x) > width || std::abs(voxel.z - cast.apex.z) > thickness(q)) return 0;
        return weights(cast)[q];
    }
    int half_width(int q) const { return half_widths_[static_cast<std::size_t>(q)]; }
    /// Half-width along z.
    int thickness(int q) const { return rule_.flat ? 0 : half_width(q); }
    /// The voxels around a pyramid with this apex.
    VoxelBox bounds(const glm::ivec3& apex) const {
        const int width = half_width(rule_.depth), deep = thickness(rule_.depth);
        return {{apex.x - width, apex.y - rule_.depth, apex.z - deep}, {apex.x + width, apex.y, apex.z + deep}};
    }
    /// What they and their weights take.
    std::size_t bytes() const;
    const ShadeRule& rule() const { return rule_; }
    const VoxelBox& clip() const { return clip_; }

private:
    double shade_of_layer(double s, int q) const;
    std::uint32_t row_of(double s);
    std::uint32_t add_row(double s);
    void grow_table();

    ShadeRule rule_;
    VoxelBox clip_;
    std::vector<int> half_widths_;
    std::vector<double> fading_;  ///< b^-q of each layer
    Column<ShadeCast> casts_, before_;
    Column<Shade> layers_;              ///< depth + 1 weights for each strength
    std::vector<double> strengths_;     ///< strength of each row
    std::vector<double> darkest_;       ///< what each row takes away in layer 0
    std::vector<std::uint32_t> table_;  ///< open addressing: 1 + number of a strength, 0: free
    std::uint32_t last_ = 0;            ///< number of the strength asked for last
    double total_ = 0;
};

}  // namespace espalier::environment
