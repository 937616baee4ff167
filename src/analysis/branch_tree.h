// A plant's skeleton as a tree of internodes in columns: what the measures of form work on. Metres.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::analysis {

/// Internode i has row i of every column. An internode comes after the one it stands on.
struct BranchTree {
    static constexpr std::int32_t ground = -1;

    std::vector<std::int32_t> parents;  ///< the internode it stands on, or `ground`
    std::vector<double> lengths;
    std::vector<double> base_radii, radii;  ///< where it begins, and at its tip
    std::vector<glm::dvec3> bases, tips;
    std::vector<std::uint64_t> modules;  ///< identities; pieces of one follow each other; 0: a module of its own
    std::vector<double> uptakes;         ///< water, cm3/d; empty where that was not recorded

    std::size_t size() const { return parents.size(); }
    /// Appends an internode; returns its row.
    std::int32_t add(std::int32_t parent, const glm::dvec3& base, const glm::dvec3& tip, double base_radius,
                     double radius, std::uint64_t module = 0);
};

/// The children of every internode: those of row i are children[offsets[i + 1]] .. children[offsets[i + 2] - 1], those
/// on the ground begin at offsets[0].
struct Children {
    std::vector<std::uint32_t> offsets;
    std::vector<std::int32_t> children;

    explicit Children(const BranchTree& tree);
    std::span<const std::int32_t> of(std::int32_t internode) const {
        const auto at = static_cast<std::size_t>(internode + 1);
        return {children.data() + offsets[at], children.data() + offsets[at + 1]};
    }
};

/// One tree per plant, in the order of `plants`; internodes of others are left out. So are internodes without length
/// (scars, buds that have not grown yet): what they bear stands on what they stand on. `uptakes` are those of the
/// internodes, or none.
std::vector<BranchTree> branch_trees(std::span<const FrameInternode> internodes, std::span<const std::uint32_t> plants,
                                     std::span<const double> uptakes = {});

/// Sums over the internodes: their lengths, and surfaces and volumes of the truncated cones they are.
double total_length(const BranchTree& tree);
double total_surface(const BranchTree& tree);
double total_volume(const BranchTree& tree);

}  // namespace espalier::analysis
