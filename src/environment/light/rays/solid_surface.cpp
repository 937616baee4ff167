#include "environment/light/rays/solid_surface.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>

namespace espalier::environment {
namespace {

/// Distances, cut off beyond three voxels.
openvdb::FloatGrid::Ptr distances(const Shape& solid, double voxel, const Box& box) {
    const glm::dvec3 low = glm::floor(box.lower / voxel) - 2.0, high = glm::ceil(box.upper / voxel) + 2.0;
    const openvdb::CoordBBox range(openvdb::Coord(int(low.x), int(low.y), int(low.z)),
                                   openvdb::Coord(int(high.x), int(high.y), int(high.z)));
    if (!(range.volume() < (std::uint64_t{1} << 27))) {
        throw RunError(fmt::format("a solid has too many voxels of {:g} m: give a larger solid_voxel", voxel));
    }
    openvdb::tools::Dense<float> dense(range, 0.0f);
    const auto width = static_cast<float>(3 * voxel);
    for_in_parallel(range.min().x(), range.max().x() + 1, [&](int x) {
        for (int y = range.min().y(); y <= range.max().y(); ++y) {
            for (int z = range.min().z(); z <= range.max().z(); ++z) {
                const double distance = solid.distance(voxel * glm::dvec3(x, y, z));
                dense.setValue(openvdb::Coord(x, y, z), std::clamp(static_cast<float>(distance), -width, width));
            }
        }
    });
    auto grid = openvdb::FloatGrid::create(width);
    grid->setTransform(voxel_transform(voxel));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    openvdb::tools::copyFromDense(dense, *grid, 0.0f);
    return grid;
}

}  // namespace

TriangleMesh surface_of(const Shape& solid, double voxel) {
    const std::optional<Box> box = solid.bounds();
    if (!box) throw RunError("a solid that light meets must have bounds: a half-space has none");
    initialize_openvdb();
    const auto grid = distances(solid, voxel, *box);
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, points, quads, 0.0);
    TriangleMesh mesh;
    for (const openvdb::Vec3s& point : points) mesh.points.emplace_back(point.x(), point.y(), point.z());
    // OpenVDB's quads run clockwise as seen from outside.
    for (const openvdb::Vec4I& quad : quads) {
        mesh.triangles.push_back({quad[0], quad[2], quad[1]});
        mesh.triangles.push_back({quad[0], quad[3], quad[2]});
    }
    return mesh;
}

}  // namespace espalier::environment
