#include "geometry/grid_operations.h"

#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "geometry/grids/active_values.h"
#include "geometry/grids/grid_file.h"

#include <fmt/format.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>

namespace espalier::geometry {
namespace {

bool has_values(const FieldGrid& field) {
    return field.grid != nullptr;
}

/// By the tree itself: an accessor of its own for each look would cost more than it saves, and one for all threads is
/// not safe.
double sampled(const openvdb::FloatGrid& grid, const openvdb::Vec3d& place) {
    return openvdb::tools::BoxSampler::sample(grid.tree(), grid.worldToIndex(place));
}

/// The mean of the active ones of the eight voxels around a place, and the middle that it holds at, in index space.
struct ActiveMean {
    double value = 0;
    openvdb::Vec3d middle{0};
    double weight = 0;  ///< 0: there is none
};

ActiveMean active_mean(const openvdb::FloatGrid& grid, const openvdb::Vec3d& place) {
    const openvdb::Coord first = openvdb::Coord::floor(place);
    ActiveMean mean;
    for (int corner = 0; corner < 8; ++corner) {
        const openvdb::Coord voxel = first + openvdb::Coord(corner & 1, corner >> 1 & 1, corner >> 2);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= 1 - std::abs(place[axis] - voxel[axis]);
        float value = 0;
        if (!(weight > 0) || !grid.tree().probeValue(voxel, value)) continue;
        mean.value += weight * value;
        mean.middle += weight * voxel.asVec3d();
        mean.weight += weight;
    }
    if (mean.weight > 0) {
        mean.value /= mean.weight;
        mean.middle /= mean.weight;
    }
    return mean;
}

double value(const FieldGrid& field, const glm::dvec3& position) {
    const openvdb::Vec3d place(position.x, position.y, position.z);
    if (!has_only_active_values(*field.grid)) return sampled(*field.grid, place);
    return active_mean(*field.grid, field.grid->worldToIndex(place)).value;
}

/// Beside voxels without a value it is the difference between those that have one.
double active_slope(const openvdb::FloatGrid& grid, const openvdb::Vec3d& place, int axis) {
    openvdb::Vec3d step(0);
    step[axis] = 1;
    ActiveMean behind = active_mean(grid, place - step), ahead = active_mean(grid, place + step);
    if (behind.weight == 0) behind = active_mean(grid, place);
    if (ahead.weight == 0) ahead = active_mean(grid, place);
    const double apart = ahead.middle[axis] - behind.middle[axis];
    if (behind.weight == 0 || ahead.weight == 0 || apart < 1e-6) return 0;
    return (ahead.value - behind.value) / (apart * grid.voxelSize()[axis]);
}

glm::dvec3 gradient(const FieldGrid& field, const glm::dvec3& position) {
    glm::dvec3 slope(0);
    const openvdb::Vec3d voxel = field.grid->voxelSize(), place(position.x, position.y, position.z);
    for (int axis = 0; axis < 3; ++axis) {
        if (has_only_active_values(*field.grid)) {
            slope[axis] = active_slope(*field.grid, field.grid->worldToIndex(place), axis);
            continue;
        }
        openvdb::Vec3d behind = place, ahead = place;
        behind[axis] -= voxel[axis];
        ahead[axis] += voxel[axis];
        slope[axis] = (sampled(*field.grid, ahead) - sampled(*field.grid, behind)) / (2 * voxel[axis]);
    }
    return slope;
}

openvdb::CoordBBox box_of(const FieldGrid& field) {
    // Nothing active yet: one voxel, so that the file opens and has the array.
    if (field.box.empty()) return {openvdb::Coord(0), openvdb::Coord(0)};
    return field.box;
}

// Without overflow: each extent is below 2^32.
bool too_large(const openvdb::Coord& size) {
    std::uint64_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        voxels *= static_cast<std::uint32_t>(size[axis]);
        if (voxels > most_dense_voxels) return true;
    }
    return false;
}

// Leaf by leaf where there is nothing else: OpenVDB looks at every node, on all threads.
Column<float> values_in(const FieldGrid& field, const openvdb::CoordBBox& box) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    Column<float> values(box.volume());
    if (!field.only_leaves) {
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
        openvdb::tools::copyToDense(*field.grid, dense);
        return values;
    }
    std::fill(values.begin(), values.end(), field.grid->background());
    const openvdb::Coord size = box.dim();
    const auto rows = static_cast<std::size_t>(size.y()), row = static_cast<std::size_t>(size.x());
    for (auto leaf = field.grid->tree().cbeginLeaf(); leaf; ++leaf) {
        openvdb::CoordBBox part = leaf->getNodeBoundingBox();
        if (!part.hasOverlap(box)) continue;
        part.intersect(box);
        const float* const of_leaf = leaf->buffer().data();
        openvdb::Coord at;
        for (at.z() = part.min().z(); at.z() <= part.max().z(); ++at.z()) {
            for (at.y() = part.min().y(); at.y() <= part.max().y(); ++at.y()) {
                at.x() = part.min().x();
                const openvdb::Coord from_corner = at - box.min();
                const auto place = [&](int axis) { return static_cast<std::size_t>(from_corner[axis]); };
                float* value = &values[(place(2) * rows + place(1)) * row + place(0)];
                for (; at.x() <= part.max().x(); ++at.x()) *value++ = of_leaf[Leaf::coordToOffset(at)];
            }
        }
    }
    return values;
}

glm::dvec3 to_glm(const openvdb::Vec3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

DenseField dense(const Field& field) {
    const FieldGrid& source = grid_of(field);
    const openvdb::CoordBBox box = box_of(source);
    const openvdb::Coord size = box.dim();
    if (too_large(size)) {
        throw RunError(
            fmt::format("field '{}' spans {} x {} x {} voxels, more than the {} a .vti may hold; record it "
                        "as field_files = [\"vdb\"] only",
                        field.name, size.x(), size.y(), size.z(), most_dense_voxels));
    }
    return {{size.x(), size.y(), size.z()},
            to_glm(source.grid->indexToWorld(box.min())),
            to_glm(source.grid->voxelSize()),
            values_in(source, box)};
}

const GridOperations operations{has_values, value,    gradient,        dense,    same_field,
                                digest_of,  bytes_of, grid_from_bytes, write_vdb};
const GridLibrary library(operations);

}  // namespace
}  // namespace espalier::geometry
