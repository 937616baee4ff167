#include "environment/soil/grid/direction.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace espalier::environment {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

void keep_free(const WaterGrid& grid, const WaterFaces& faces, WaterStencil& stencil) {
    bool all = true;
    for (int corner = 0; corner < 8; ++corner) {
        if (stencil.weight[corner] == 0 || faces.free(grid.cell(stencil.voxel[corner]))) continue;
        stencil.weight[corner] = 0;
        all = false;
    }
    if (all) return;
    const double sum = sum_in_pairs(stencil.weight);
    if (sum == 0) return;
    for (double& weight : stencil.weight) weight /= sum;
}

double difference_along(const WaterGrid& grid, const WaterFaces& faces, const WaterBrick& contents,
                        const glm::ivec3& voxel, int axis) {
    glm::ivec3 lower = voxel, upper = voxel;
    --lower[axis];
    ++upper[axis];
    const std::size_t own = grid.cell(voxel);
    const bool lower_free = grid.has(lower) && faces.free(grid.cell(lower));
    const bool upper_free = grid.has(upper) && faces.free(grid.cell(upper));
    if (lower_free && upper_free) return 0.5 * (contents[grid.cell(upper)] - contents[grid.cell(lower)]);
    if (upper_free) return contents[grid.cell(upper)] - contents[own];
    if (lower_free) return contents[own] - contents[grid.cell(lower)];
    return 0;
}

bool is_clear(const WaterGrid& grid, const WaterSolids& solids, const glm::dvec3& from, const glm::dvec3& heading,
              double length) {
    if (!(length > 0)) return true;
    // The domain is convex; a tip above the soil may grow into it.
    return grid.contains(from + length * heading) && !solids.blocks(from, heading, length, grid.voxel() / 16);
}

/// A unit vector across `heading`, as far as possible along the first of `candidates` that is not parallel to it.
glm::dvec3 across(const glm::dvec3& heading, std::initializer_list<glm::dvec3> candidates) {
    for (const glm::dvec3& candidate : candidates) {
        const glm::dvec3 part = candidate - glm::dot(candidate, heading) * heading;
        const double length = glm::length(part);
        if (length > 1e-9) return part / length;
    }
    return {0, 0, 0};
}

/// The directions to try at one angle from the heading, as azimuths in degrees; 0 is where the tip is drawn to.
/// In the plane there are two; in space twelve.
const std::vector<int>& azimuths(bool flat) {
    static const std::vector<int> in_plane = {0, 180};
    static const std::vector<int> in_space = {0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180};
    return flat ? in_plane : in_space;
}

}  // namespace

WaterSample sample_water(const WaterGrid& grid, const WaterFaces& faces, const WaterBrick& contents,
                         const glm::dvec3& point) {
    WaterSample sample;
    if (!grid.contains(point)) return sample;
    sample.stencil = grid.stencil(point);
    keep_free(grid, faces, sample.stencil);
    std::array<double, 8> content{};
    std::array<std::array<double, 8>, 3> differences{};
    for (int corner = 0; corner < 8; ++corner) {
        const double weight = sample.stencil.weight[corner];
        if (weight == 0) continue;
        const glm::ivec3& voxel = sample.stencil.voxel[corner];
        content[corner] = weight * contents[grid.cell(voxel)];
        for (int axis = 0; axis < 3; ++axis) {
            differences[axis][corner] = weight * difference_along(grid, faces, contents, voxel, axis);
        }
    }
    sample.content = sum_in_pairs(content);
    for (int axis = 0; axis < 3; ++axis) sample.gradient[axis] = sum_in_pairs(differences[axis]) / grid.voxel();
    return sample;
}

WaterHeading clear_heading(const WaterGrid& grid, const WaterSolids& solids, const Pose& pose,
                           const glm::dvec3& direction, double length) {
    glm::dvec3 wanted = pose.heading + direction;
    if (glm::length(wanted) < 1e-9) wanted = pose.heading;
    if (grid.flat()) wanted.z = 0;
    const double size = glm::length(wanted);
    if (size < 1e-9) return {};
    wanted /= size;
    if (is_clear(grid, solids, pose.position, wanted, length)) return {wanted, true};

    glm::dvec3 side = across(wanted, {direction, pose.left, pose.up});
    if (grid.flat()) {
        const glm::dvec3 left{-wanted.y, wanted.x, 0};
        side = glm::dot(direction, left) < 0 ? -left : left;
    }
    const glm::dvec3 other = glm::cross(wanted, side);
    for (int degrees = 2; degrees <= 180; degrees += 2) {
        const double turn = degrees * radians_per_degree;
        for (const int azimuth : azimuths(grid.flat())) {
            const double around = azimuth * radians_per_degree;
            const glm::dvec3 away =
                grid.flat() ? (azimuth == 0 ? side : -side) : math::cos(around) * side + math::sin(around) * other;
            const glm::dvec3 heading = glm::normalize(math::cos(turn) * wanted + math::sin(turn) * away);
            if (is_clear(grid, solids, pose.position, heading, length)) return {heading, true};
        }
    }
    return {};
}

}  // namespace espalier::environment
