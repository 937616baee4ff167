// One path of light.
#pragma once

#include "environment/light/optics/optics.h"

#include <glm/vec3.hpp>

#include <array>

namespace espalier::environment {

/// What it carries in each band, as a share of what it began with.
using BandWeights = std::array<double, most_bands>;

struct LightPath {
    glm::dvec3 origin, direction;
    double near = 0;  ///< nothing is met before
    bool is_first = true, from_sun = false;
    BandWeights weights{};
};

}  // namespace espalier::environment
