#include "geometry/grids/voxel_values.h"

#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"

using namespace espalier;
using namespace espalier::geometry;

TEST_CASE("numbers of voxels become a grid: sums, centres of voxels, and what a viewer is shown", "[fields]") {
    VoxelValues values(0.5, {1, 2, 3});
    values.set({-1, 4, 2}, 7);
    values.add({-1, 4, 2}, 0.5f);
    values.add({0, 4, 2}, 3);
    const auto field = values.grid();
    const auto read = field->grid->getConstAccessor();
    CHECK(read.getValue({-1, 4, 2}) == 7.5f);
    CHECK(read.getValue({0, 4, 2}) == 3);
    CHECK(read.getValue({0, 0, 0}) == 0);
    CHECK(field->grid->activeVoxelCount() == 2);
    CHECK(field->box == openvdb::CoordBBox({-1, 4, 2}, {0, 4, 2}));
    const openvdb::Vec3d centre = field->grid->indexToWorld(openvdb::Coord(0, 0, 0));
    CHECK(glm::dvec3(centre.x(), centre.y(), centre.z()) == glm::dvec3(1.25, 2.25, 3.25));
}

TEST_CASE("a viewer is shown voxels without numbers if that is said", "[fields]") {
    VoxelValues values(1, {0, 0, 0});
    values.show({0, 0, 0}, {3, 0, 2});
    CHECK(values.grid()->box == openvdb::CoordBBox({0, 0, 0}, {3, 0, 2}));
    CHECK(values.grid()->grid->activeVoxelCount() == 0);
}
