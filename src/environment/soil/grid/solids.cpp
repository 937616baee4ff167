#include "environment/soil/grid/solids.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"

#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

double sample(const FieldGrid& field, const glm::dvec3& point) {
    const openvdb::Vec3d index = field.grid->worldToIndex(openvdb::Vec3d(point.x, point.y, point.z));
    return openvdb::tools::BoxSampler::sample(field.grid->tree(), index);
}

}  // namespace

WaterSolids::WaterSolids(const SoilSpace& space)
    : obstacles_(space.obstacles), obstacle_name_(space.obstacle_field), container_name_(space.container_field) {}

bool WaterSolids::look(const Fields& fields) {
    bool changed = false;
    const auto take = [&](const std::string& name, std::shared_ptr<const FieldGrid>& known) {
        if (name.empty()) return;
        const Field& field = fields.need(name);
        changed = changed || field.grid != known;
        known = field.grid;
    };
    take(obstacle_name_, obstacle_field_);
    take(container_name_, container_field_);
    return changed;
}

double WaterSolids::clearance(const glm::dvec3& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& obstacle : obstacles_) nearest = std::min(nearest, obstacle->distance(point));
    if (obstacle_field_) nearest = std::min(nearest, sample(*obstacle_field_, point));
    if (container_field_) nearest = std::min(nearest, -sample(*container_field_, point));
    return nearest;
}

double WaterSolids::distance_to_wall(const glm::dvec3& point, const WaterGrid& grid, bool joined_x,
                                     bool joined_z) const {
    const glm::dvec3 lower = grid.lower(), upper = grid.upper();
    const bool joined[] = {joined_x, false, joined_z};
    glm::dvec3 at = point;
    double nearest = point.y - lower.y;
    for (const int axis : {0, 2}) {
        if (axis == 2 && grid.flat()) continue;
        const double width = upper[axis] - lower[axis];
        if (joined[axis]) {
            at[axis] -= width * std::floor((at[axis] - lower[axis]) / width);
        } else {
            nearest = std::min({nearest, point[axis] - lower[axis], upper[axis] - point[axis]});
        }
    }
    return std::min(nearest, clearance(at));
}

bool WaterSolids::blocks(const glm::dvec3& from, const glm::dvec3& direction, double length, double resolution) const {
    if (!any()) return false;
    for (double at = 0; at < length;) {
        const double distance = clearance(from + at * direction);
        if (!(distance > 0)) return true;
        at += std::max(distance, resolution);
    }
    return !(clearance(from + length * direction) > 0);
}

std::vector<std::uint8_t> WaterSolids::free_voxels(const WaterGrid& grid) const {
    std::vector<std::uint8_t> free(grid.voxels(), 1);
    if (!any()) return free;
    for_in_parallel(std::size_t{0}, grid.rows(), [&](std::size_t row) {
        std::size_t voxel = row * grid.size().x;
        grid.for_cells_of(row,
                          [&](std::size_t cell) { free[voxel++] = clearance(grid.centre(grid.voxel_of(cell))) > 0; });
    });
    return free;
}

}  // namespace espalier::environment
