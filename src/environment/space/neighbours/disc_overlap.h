// Discs, or balls, of all sizes by place: which of them reach into another.
#pragma once

#include "environment/space/neighbours/point_grid.h"

#include <glm/geometric.hpp>

#include <memory>
#include <span>
#include <vector>

namespace espalier::environment {

/// One point grid per size, doubling from each to the next, so that one large disc does not make all cells large.
class DiscOverlap {
public:
    DiscOverlap(std::span<const glm::dvec3> centres, std::span<const double> radii);

    /// Calls visit(other) for the discs that overlap disc `i` (distance <= sum of the radii) and are at least of the
    /// size class of `smallest`, until it returns false. False if it did. Not for `i` itself.
    template <class Visit>
    bool visit_overlapping(std::uint32_t i, double smallest, const Visit& visit) const {
        for (auto level = levels_.rbegin(); level != levels_.rend() && level->largest >= smallest; ++level) {
            const bool goes_on = level->grid.visit_around(centres_[i], radii_[i] + level->largest, [&](auto other) {
                const bool apart = glm::distance(centres_[other], centres_[i]) > radii_[other] + radii_[i];
                return other == i || apart || visit(other);
            });
            if (!goes_on) return false;
        }
        return true;
    }

private:
    struct Level {
        double largest;  ///< radius
        PointGrid grid;
    };

    std::span<const glm::dvec3> centres_;
    std::span<const double> radii_;
    std::vector<Level> levels_;  ///< the smallest discs first
};

}  // namespace espalier::environment
