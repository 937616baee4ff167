// How far a query reaches, for EnvironmentProcess::reach().
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <limits>

namespace espalier::environment {

/// What is as near as a distance, as computed, lies in a box so many times as wide.
constexpr double beyond_rounding = 1 + 1e-9;

constexpr double everywhere = std::numeric_limits<double>::infinity();

/// What is at most `aside` from a place along each axis.
inline Box box_around(const glm::dvec3& place, const glm::dvec3& aside) {
    return {place - aside, place + aside};
}

inline bool overlap(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
    }
    return true;
}

}  // namespace espalier::environment
