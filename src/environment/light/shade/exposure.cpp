#include "environment/light/shade/exposure.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::environment {
namespace {

/// How far from `from` a ray can still meet the solid; for one without bounds, farther than any scene reaches.
double range_of(const Shape& solid, const glm::dvec3& from) {
    const std::optional<Box> bounds = solid.bounds();
    if (!bounds) return 1e5;
    const glm::dvec3 farthest = glm::max(glm::abs(bounds->lower - from), glm::abs(bounds->upper - from));
    return glm::length(farthest);
}

}  // namespace

bool meets(const Shape& solid, const glm::dvec3& from, const glm::dvec3& direction, double length, double least_step) {
    for (double along = 0; along < length;) {
        const double distance = solid.distance(from + along * direction);
        if (distance <= 0) return true;
        along += std::max(distance, least_step);
    }
    return false;
}

std::vector<bool> unobstructed(const Shape& solid, const glm::dvec3& from, std::span<const glm::dvec3> directions,
                               double least_step) {
    const double range = range_of(solid, from);
    std::vector<bool> free;
    for (const glm::dvec3& direction : directions) free.push_back(!meets(solid, from, direction, range, least_step));
    return free;
}

}  // namespace espalier::environment
