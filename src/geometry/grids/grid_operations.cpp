#include "geometry/grid_operations.h"

#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "geometry/grids/grid_file.h"

#include <fmt/format.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>

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

double value(const FieldGrid& field, const glm::dvec3& position) {
    return sampled(*field.grid, {position.x, position.y, position.z});
}

glm::dvec3 gradient(const FieldGrid& field, const glm::dvec3& position) {
    glm::dvec3 slope(0);
    const openvdb::Vec3d voxel = field.grid->voxelSize();
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d behind(position.x, position.y, position.z), ahead = behind;
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
