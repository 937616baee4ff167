#include "environment/shade/exposure.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <numbers>

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

std::vector<glm::dvec3> sun_path(double latitude, std::span<const double> days, std::int64_t samples,
                                 const glm::dvec3& north) {
    const double phi = glm::radians(latitude);
    const glm::dvec3 up(0, 1, 0), east = glm::cross(north, up);
    std::vector<glm::dvec3> directions;
    for (const double day : days) {
        const double declination = glm::radians(23.45 * math::sin(2 * std::numbers::pi * (284 + day) / 365));
        const double sunset = math::acos(std::clamp(-math::tan(phi) * math::tan(declination), -1.0, 1.0));
        if (!(sunset > 0)) continue;
        for (std::int64_t i = 0; i < samples; ++i) {
            const double hour = sunset * ((2 * static_cast<double>(i) + 1) / static_cast<double>(samples) - 1);
            const double height =
                math::sin(phi) * math::sin(declination) + math::cos(phi) * math::cos(declination) * math::cos(hour);
            const double northward =
                math::cos(phi) * math::sin(declination) - math::sin(phi) * math::cos(declination) * math::cos(hour);
            directions.push_back(height * up + northward * north - math::cos(declination) * math::sin(hour) * east);
        }
    }
    return directions;
}

std::vector<bool> unobstructed(const Shape& solid, const glm::dvec3& from, std::span<const glm::dvec3> directions,
                               double least_step) {
    const double range = range_of(solid, from);
    std::vector<bool> free;
    for (const glm::dvec3& direction : directions) free.push_back(!meets(solid, from, direction, range, least_step));
    return free;
}

}  // namespace espalier::environment
