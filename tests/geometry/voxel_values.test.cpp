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

TEST_CASE("a box of numbers is x fastest, and its zeros are not set", "[fields]") {
    VoxelValues values(1, {0, 0, 0});
    values.fill({2, 1, 2}, std::vector<float>{1, 0, 3, 4});
    const auto field = values.grid();
    CHECK(field->box == openvdb::CoordBBox({0, 0, 0}, {1, 0, 1}));
    CHECK(field->grid->activeVoxelCount() == 3);
    CHECK(field->grid->tree().getValue({0, 0, 1}) == 3);
}

TEST_CASE("the voxel that is read is that with the nearest centre", "[fields]") {
    VoxelValues values(0.5, {1, 0, 0});
    values.set({0, 0, 0}, 2);
    values.set({1, 0, 0}, 5);
    const VoxelReader reader(values.grid());
    CHECK(reader.value({1.1, 0.4, 0.2}) == 2);
    CHECK(reader.value({1.49, 0.4, 0.2}) == 2);
    CHECK(reader.value({1.51, 0.4, 0.2}) == 5);
    CHECK(reader.value({2.1, 0.4, 0.2}) == 0);
    CHECK(bytes_held(*values.grid()) > 2 * sizeof(float));
}
