// Shadow pyramids (Palubicki et al. 2009): what one organ takes away from the light below it, as whole numbers, so that
// sums are exact whatever their order.
#pragma once

#include "espalier/base/column.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace espalier {

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

/// What a query of strength `s` takes away in layer q: s a b^-q.
/// Where shadows multiply it lets through 1 - min(1, s a b^-q), kept as an optical depth.
double shade_of_layer(const ShadeRule& rule, double s, int q);
/// The square's half-width in layer q: floor(spread q).
int half_width(const ShadeRule& rule, int q);
/// Full light less the shade, or damped by it.
double light_under(const ShadeRule& rule, Shade shade);
double shade_value(Shade shade);

/// Voxels from `lower` to `upper`, both included.
struct VoxelBox {
    glm::ivec3 lower{std::numeric_limits<int>::max()};
    glm::ivec3 upper{std::numeric_limits<int>::min()};

    bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
    bool has(const glm::ivec3& v) const {
        return v.x >= lower.x && v.y >= lower.y && v.z >= lower.z && v.x <= upper.x && v.y <= upper.y && v.z <= upper.z;
    }
    void add(const VoxelBox& other);
    VoxelBox within(const VoxelBox& other) const;
    double voxels() const;
};

/// One pyramid: its apex, and which row of ShadeCasts::layers tells its weights.
struct ShadeCast {
    glm::ivec3 apex;
    std::uint32_t row;

    friend bool operator==(const ShadeCast&, const ShadeCast&) = default;
};

/// All pyramids of a step.
class ShadeCasts {
public:
    explicit ShadeCasts(const ShadeRule& rule) : rule_(rule) {}

    void clear();
    /// Casts of equal strength that follow each other share their weights. Throws RunError where sums would overflow.
    void add(const glm::ivec3& apex, double s);

    std::span<const ShadeCast> casts() const { return casts_; }
    Shade weight(const ShadeCast& cast, int q) const { return layers_[cast.row + static_cast<std::uint32_t>(q)]; }
    /// What `cast` adds to `voxel`.
    Shade at(const ShadeCast& cast, const glm::ivec3& voxel) const;
    int half_width(int q) const { return half_widths_[static_cast<std::size_t>(q)]; }
    VoxelBox bounds(const ShadeCast& cast) const;
    const ShadeRule& rule() const { return rule_; }

    friend bool operator==(const ShadeCasts& a, const ShadeCasts& b) {
        return a.casts_ == b.casts_ && a.layers_ == b.layers_;
    }

private:
    ShadeRule rule_;
    std::vector<int> half_widths_ = widths(rule_);
    std::vector<ShadeCast> casts_;
    Column<Shade> layers_;  ///< depth + 1 weights for each strength
    double last_strength_ = 0;
    double total_ = 0;

    static std::vector<int> widths(const ShadeRule& rule);
};

}  // namespace espalier
