#include "environment/exchange/covering.h"

#include "espalier/base/error.h"

#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::environment {

double read_voxel(const Settings& settings, std::optional<double> otherwise) {
    const Range range = Range::between(smallest_voxel, std::numeric_limits<double>::infinity());
    return otherwise ? settings.number_or("voxel", *otherwise, range) : settings.number("voxel", range);
}

glm::ivec3 voxel_at(const glm::dvec3& place, double voxel) {
    constexpr double farthest = 1 << 30;
    const glm::dvec3 at = glm::floor(place / voxel);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(at[axis]) < farthest) continue;
        throw RunError(fmt::format("a place at ({:g}, {:g}, {:g}) is too far away for voxels of {:g} m", place.x,
                                   place.y, place.z, voxel));
    }
    return glm::ivec3(at);
}

double voxels_across(double extent, double voxel) {
    return std::max(1.0, std::ceil(extent / voxel - 1e-6));
}

glm::dvec3 voxels_over(const Box& domain, double voxel) {
    glm::dvec3 count;
    for (int axis = 0; axis < 3; ++axis) {
        count[axis] = voxels_across(domain.upper[axis] - domain.lower[axis], voxel);
    }
    return count;
}

glm::dvec3 lower_corner_over(const Box& domain, double voxel) {
    return 0.5 * (domain.lower + domain.upper) - 0.5 * voxel * voxels_over(domain, voxel);
}

}  // namespace espalier::environment
