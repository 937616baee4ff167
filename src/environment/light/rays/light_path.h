// One path of light.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include "environment/light/optics/optics.h"

#include <glm/vec3.hpp>

#include <array>
#include <cmath>

namespace espalier::environment {

/// What it carries in each band, as a share of what it began with.
using BandWeights = std::array<double, most_bands>;

/// The same place inside a period that repeats along x and z.
inline glm::dvec3 wrapped(glm::dvec3 place, const Box& period) {
    for (const int axis : {0, 2}) {
        const double low = period.lower[axis], size = period.upper[axis] - low;
        place[axis] -= size * std::floor((place[axis] - low) / size);
    }
    return place;
}

struct LightPath {
    glm::dvec3 origin, direction;
    double near = 0;  ///< nothing is met before
    bool from_sun = false;
    bool can_be_sought = false;  ///< organs find its source by rays of their own
    enum class Begin : std::uint8_t { source, ray, point };
    Begin begin =
        Begin::source;         ///< or where a ray from an organ or a point of a projection is, which it meets at once
    std::uint32_t bounce = 0;  ///< how often it has met something
    BandWeights weights{};
    BandWeights enough{};  ///< with less than this, chance decides whether all of it goes on
};

}  // namespace espalier::environment
