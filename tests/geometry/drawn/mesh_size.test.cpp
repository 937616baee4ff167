// How large a mesh will be, against the mesh that is made.
#include "geometry/drawn/mesh_size.h"

#include "espalier/geometry/generalized_cylinder.h"

#include "catch.h"
#include "geometry/drawn/plant_mesh.h"

#include <array>
#include <memory>

using namespace espalier;
using namespace espalier::geometry;

namespace {

struct Made {
    std::size_t points = 0, corners = 0, cells = 0, point_runs = 0, cell_runs = 0;
};

Made made(const PlantGeometry& geometry) {
    PlantMesh mesh;
    OrganSource organs;
    mesh.begin();
    add_drawn(mesh, geometry, organs, 0);
    mesh.end();
    Made made;
    made.points = mesh.size();
    made.point_runs = mesh.owners.values.size();
    for (const Cells* cells : {&mesh.vertices, &mesh.lines, &mesh.polygons}) {
        made.corners += cells->connectivity.size();
        made.cells += cells->offsets.size();
        made.cell_runs += cells->owners.values.size();
    }
    return made;
}

void check_exactly(const PlantGeometry& geometry) {
    SurfaceSizes surfaces;
    const MeshSize size = mesh_size(geometry, surfaces);
    const Made mesh = made(geometry);
    CHECK(mesh.points > 0);
    CHECK(size.points == mesh.points);
    CHECK(size.corners == mesh.corners);
    CHECK(size.cells == mesh.cells);
    CHECK(size.point_runs == mesh.point_runs);
    CHECK(size.cell_runs == mesh.cell_runs);
}

/// Each of a module of its own.
PlantGeometry organs(Organ::Shape shape, std::uint16_t sides, std::uint32_t count, std::uint32_t surface = 0) {
    PlantGeometry geometry;
    for (std::uint32_t module = 0; module < count; ++module) {
        Organ organ{};
        organ.module = module;
        organ.shape = shape;
        organ.surface = surface;
        organ.size = {1, 1, 1};
        organ.sides = sides;
        geometry.organs.push_back(organ);
    }
    return geometry;
}

}  // namespace

TEST_CASE("the size of organs' meshes is known before they are made", "[geometry]") {
    const auto shape = GENERATE(Organ::Shape::disc, Organ::Shape::circle, Organ::Shape::sphere, Organ::Shape::surface);
    const auto sides = GENERATE(std::uint16_t{3}, std::uint16_t{8}, std::uint16_t{32});
    check_exactly(organs(shape, sides, 5));
    check_exactly(organs(shape, sides, 40000));  // counted by several threads
}

TEST_CASE("the size of surfaces' meshes is that of what the view file describes", "[geometry]") {
    auto shapes = std::make_shared<Shapes>();
    Surface& patch = shapes->surfaces['p'];
    patch.precision_s = 7;
    patch.patches.emplace_back();
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) patch.patches[0].points[row][column] = {column, row, 0};
    }
    shapes->surfaces['t'].triangles.resize(3);
    PlantGeometry geometry = organs(Organ::Shape::surface, 8, 4, 'p');
    for (const std::uint32_t surface : {'t', 'u', 't'}) {  // nobody describes u
        geometry.organs.push_back(organs(Organ::Shape::surface, 8, 1, surface).organs[0]);
        geometry.organs.back().module = std::uint32_t(geometry.organs.size());
    }
    geometry.shapes = shapes;
    check_exactly(geometry);
}

TEST_CASE("the sizes of axes and labels are known before they are made", "[geometry]") {
    PlantGeometry geometry;
    for (std::uint32_t i = 0; i < 6; ++i) {
        geometry.internodes.push_back({i, i / 3, 0, 0, 0, {i / 3, i % 3, 0}, {i / 3, i % 3 + 1, 0}, 0.5, 0.5});
    }
    geometry.axes = 2;
    geometry.labels.push_back({2, 0, 0, {0, 1, 0}, "a bud"});
    check_exactly(geometry);
    SurfaceSizes surfaces;
    CHECK(mesh_size(geometry, surfaces, 3).cells == mesh_size(geometry, surfaces).cells + 3);
}

TEST_CASE("polygons take no more than was foreseen", "[geometry]") {
    PlantGeometry geometry;
    const std::array<glm::dvec3, 5> corners{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}}};
    for (std::uint32_t count = 3; count <= 5; ++count) {
        geometry.polygons.push_back({count, std::uint32_t(geometry.vertices.size()), count, 0, 0});
        geometry.vertices.insert(geometry.vertices.end(), corners.begin(), corners.begin() + count);
    }
    SurfaceSizes surfaces;
    const MeshSize size = mesh_size(geometry, surfaces);
    const Made mesh = made(geometry);
    CHECK(size.points == mesh.points);
    CHECK(size.point_runs == mesh.point_runs);
    CHECK(size.corners >= mesh.corners);
    CHECK(size.corners <= 3 * mesh.corners);
    CHECK(size.cells >= mesh.cells);
    CHECK(size.cell_runs == mesh.cell_runs);
}
