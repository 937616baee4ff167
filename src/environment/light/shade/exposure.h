// What of the sky and of the sun's path is seen past a solid.
#pragma once

#include "espalier/environment/shape.h"

#include <span>
#include <vector>

namespace espalier::environment {

/// Whether a ray of that length meets the solid. It steps from distance to distance, at least by `least_step`.
bool meets(const Shape& solid, const glm::dvec3& from, const glm::dvec3& direction, double length, double least_step);

/// In which of `directions` a ray from `from` meets nothing of `solid`, as `meets` finds; in none inside it.
std::vector<bool> unobstructed(const Shape& solid, const glm::dvec3& from, std::span<const glm::dvec3> directions,
                               double least_step);

}  // namespace espalier::environment
