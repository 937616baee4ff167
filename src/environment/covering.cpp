#include "environment/covering.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

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
