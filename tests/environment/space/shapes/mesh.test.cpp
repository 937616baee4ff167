#include "espalier/base/file.h"
#include "espalier/environment/shape.h"

#include "base/parallel.h"
#include "catch.h"
#include "environment/space/shapes/mesh_files.h"
#include "environment/space/shapes/tables.h"
#include "picture_bytes.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

std::string mesh_table(const std::filesystem::path& file, double voxel) {
    return fmt::format("shape = 'mesh'\nfile = '{}'\nvoxel = {}", file.string(), voxel);
}

std::string refusal_of(const std::filesystem::path& file, const std::string& more = "") {
    try {
        shape_of(fmt::format("shape = 'mesh'\nfile = '{}'\n{}", file.string(), more));
    } catch (const UserError& error) {
        return error.what();
    }
    return "accepted";
}

const char* const tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

}  // namespace

TEST_CASE("a sphere mesh is a sphere to within half a voxel, near and far", "[shape]") {
    const TemporaryFolder folder;
    const auto file = folder.write("sphere.ply", binary_ply(unit_sphere(80)));
    const double voxel = 0.05;
    const auto mesh = shape_of(mesh_table(file, voxel));
    double largest = 0;
    for (const glm::dvec3& point : random_points(10000, 3)) {
        const double exact = glm::length(point) - 1;
        const Shape::Sample sample = mesh->sample(point);
        largest = std::max(largest, std::abs(mesh->distance(point) - exact));
        REQUIRE(sample.distance == mesh->distance(point));
        if (std::abs(exact) > 0.5 * voxel) REQUIRE(mesh->inside(point) == (exact < 0));
        if (exact > -0.8) REQUIRE(glm::dot(sample.normal, glm::normalize(point)) > 0.98);
        REQUIRE(glm::length(sample.normal) == Approx(1).epsilon(1e-9));
        REQUIRE(std::abs(glm::length(sample.nearest) - 1) < 0.5 * voxel);
    }
    CHECK(largest < 0.5 * voxel);
}

TEST_CASE("a box mesh is the box to within half a voxel, from OBJ, STL and PLY alike", "[shape]") {
    const TemporaryFolder folder;
    const TestMesh cube = box_of_squares({-1, -0.5, -2}, {0.5, 1.5, 1});
    const double voxel = 0.1;
    const auto exact = shape_of("shape = 'box'\nlower = [-1, -0.5, -2]\nupper = [0.5, 1.5, 1]");
    const std::filesystem::path files[] = {
        folder.write("box.ply", binary_ply(triangulated(cube))), folder.write("box.STL", text_stl(cube)),
        folder.write("box.obj", text_obj(triangulated(cube))), folder.write("squares.obj", text_obj(cube))};
    for (const auto& file : files) {
        INFO(file);
        const auto mesh = shape_of(mesh_table(file, voxel));
        for (const glm::dvec3& point : random_points(10000, 3)) {
            const double distance = exact->distance(point);
            REQUIRE(std::abs(mesh->distance(point) - distance) < 0.5 * voxel);
            if (std::abs(distance) > 0.5 * voxel) REQUIRE(mesh->inside(point) == (distance < 0));
        }
    }
}

TEST_CASE("a level set too large for a dense copy reads the same", "[shape]") {
    const TemporaryFolder folder;
    const auto file = folder.write("sphere.ply", binary_ply(unit_sphere(100)));
    const auto mesh = shape_of(mesh_table(file, 0.0076));  // 263 voxels across
    for (const glm::dvec3& point : random_points(5000, 1.2)) {
        REQUIRE(std::abs(mesh->distance(point) - (glm::length(point) - 1)) < 0.0038);
    }
}

TEST_CASE("mesh distances are the same bits with one thread and with many", "[shape]") {
    const TemporaryFolder folder;
    const auto file = folder.write("sphere.ply", binary_ply(unit_sphere(40)));
    const std::vector<glm::dvec3> points = random_points(20000, 1.5);
    const auto distances = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto mesh = shape_of(mesh_table(file, 0.03));
        std::vector<double> result(points.size());
        for_in_parallel(std::size_t{0}, points.size(), [&](std::size_t i) { result[i] = mesh->distance(points[i]); });
        return result;
    };
    CHECK(distances(1) == distances(4));
}

TEST_CASE("a bad mesh is refused with its name and what is wrong", "[shape]") {
    const TemporaryFolder folder;
    const auto file = [&](const char* name, const std::string& text) {
        write_text(folder.path() / name, text);
        return folder.path() / name;
    };
    CHECK_THAT(refusal_of(folder.path() / "none.ply"),
               Contains("test.toml:2") && Contains("there is no file") && Contains("none.ply"));
    CHECK_THAT(refusal_of(folder.path()), Contains("cannot be read"));
    CHECK_THAT(refusal_of(file("text.ply", "Dear reader,\nno mesh here.\n")),
               Contains("text.ply") && Contains("not a whole"));
    CHECK_THAT(refusal_of(file("text.obj", "Dear reader,\nno mesh here.\n")), Contains("text.obj"));
    CHECK_THAT(refusal_of(file("text.stl", "Dear reader,\nno mesh here.\n")), Contains("text.stl"));
    CHECK_THAT(refusal_of(file("text.xyz", tetrahedron)), Contains("must end in .obj, .stl or .ply"));
    CHECK_THAT(refusal_of(file("zero.ply", "")), Contains("zero.ply"));
    CHECK_THAT(refusal_of(file("zero.obj", "")), Contains("zero.obj") && Contains("empty"));
    CHECK_THAT(refusal_of(file("zero.stl", "")), Contains("zero.stl"));
    CHECK_THAT(refusal_of(file("points.obj", "v 0 0 0\nv 1 0 0\n")), Contains("empty"));
    CHECK_THAT(refusal_of(file("open.obj", std::string(tetrahedron, std::string(tetrahedron).size() - 8))),
               Contains("not closed: 3 of its edges are open"));
    CHECK_THAT(refusal_of(file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n")), Contains("no volume"));
    CHECK_THAT(refusal_of(file("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")), Contains("index.obj"));
    CHECK_THAT(refusal_of(file("zero_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n")), Contains("zero_index.obj"));
    CHECK_THAT(refusal_of(file("good.obj", tetrahedron)), Contains("accepted"));
    CHECK_THAT(refusal_of(folder.path() / "good.obj", "voxel = 1e-9"),
               Contains("test.toml:3") && Contains("at least 1.5e-05"));
    CHECK_THAT(refusal_of(folder.path() / "good.obj", "voxel = 1.5e-5"), Contains("GB"));
    CHECK_THAT(refusal_of(folder.path() / "good.obj", "voxel = 10"), Contains("thinner"));
    CHECK_THAT(refusal_of(folder.path() / "good.obj", "voxel = 0"), Contains("'voxel' must be at least"));
}

namespace {

/// Largest difference of two shapes in distance and normal, at points all around.
double difference(const Shape& one, const Shape& other) {
    double largest = 0;
    for (const glm::dvec3& point : random_points(2000, 2)) {
        const Shape::Sample a = one.sample(point), b = other.sample(point);
        largest = std::max({largest, std::abs(a.distance - b.distance), glm::length(a.normal - b.normal)});
    }
    return largest;
}

std::string text_of(const TestMesh& mesh, const char* end_of_line = "\n") {
    std::string text;
    for (const glm::dvec3& p : mesh.points) text += fmt::format("v {:.9f} {:.9f} {:.9f}{}", p.x, p.y, p.z, end_of_line);
    for (const auto& polygon : mesh.polygons) {
        text += "f";
        for (const std::uint32_t corner : polygon) text += fmt::format(" {}", corner + 1);
        text += end_of_line;
    }
    return text;
}

}  // namespace

TEST_CASE("a mesh whose copies of a vertex differ by a rounding is closed", "[shape]") {
    const TemporaryFolder folder;
    const TestMesh sphere = unit_sphere(24);
    TestMesh apart;  // every triangle has corners of its own
    for (const auto& polygon : sphere.polygons) {
        apart.polygons.emplace_back();
        for (const std::uint32_t corner : polygon) {
            const double error = 1e-7 * static_cast<double>(apart.points.size() % 3) - 1e-7;
            apart.polygons.back().push_back(static_cast<std::uint32_t>(apart.points.size()));
            apart.points.push_back(sphere.points[corner] + glm::dvec3(error, -error, error));
        }
    }
    const auto whole = shape_of(mesh_table(folder.write("whole.obj", text_of(sphere)), 0.05));
    const auto welded = shape_of(mesh_table(folder.write("apart.obj", text_of(apart)), 0.05));
    CHECK(difference(*whole, *welded) < 1e-4);
    for (glm::dvec3& point : apart.points) point += 1e-3 * glm::sin(1e6 * point);
    CHECK_THAT(refusal_of(folder.write("torn.obj", text_of(apart))), Contains("not closed"));
}

TEST_CASE("triangles that face either way make the mesh that they make facing outward", "[shape]") {
    const TemporaryFolder folder;
    const TestMesh sphere = unit_sphere(24);
    TestMesh mixed = sphere, inward = sphere;
    for (std::size_t i = 0; i < sphere.polygons.size(); ++i) {
        if (i % 3 != 0) std::reverse(mixed.polygons[i].begin(), mixed.polygons[i].end());
        std::reverse(inward.polygons[i].begin(), inward.polygons[i].end());
    }
    const auto outward = shape_of(mesh_table(folder.write("outward.obj", text_of(sphere)), 0.05));
    for (const auto& [name, mesh] : {std::pair{"mixed.obj", mixed}, {"inward.obj", inward}}) {
        const auto turned = shape_of(mesh_table(folder.write(name, text_of(mesh)), 0.05));
        CHECK(difference(*outward, *turned) < 1e-5);
        const glm::dvec3 on_surface = sphere.points[50];  // where the triangle itself says where outside is
        CHECK(glm::dot(turned->sample(on_surface).normal, on_surface) > 0.9);
    }
    // As many face in as out: their signed volumes cancel.
    TestMesh box = triangulated(box_of_squares({-1, -1, -1}, {1, 1, 1}));
    for (std::size_t i = 0; i < box.polygons.size(); i += 2)
        std::reverse(box.polygons[i].begin(), box.polygons[i].end());
    CHECK(refusal_of(folder.write("box.obj", text_of(box))) == "accepted");
}

TEST_CASE("lines of an OBJ that end in a backslash go on in the next", "[shape]") {
    const TemporaryFolder folder;
    const std::string broken =
        "v 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nv 0 0 1\nf 1 3 \\\r\n2\nf 1 \\\n2 \\\n4\nf 2 3 4\nf 1 4 3\n";
    const auto plain = shape_of(mesh_table(folder.write("plain.obj", tetrahedron), 0.02));
    CHECK(difference(*plain, *shape_of(mesh_table(folder.write("broken.obj", broken), 0.02))) < 1e-5);
    // The line of a mistake is counted as an editor counts it.
    CHECK_THAT(refusal_of(folder.write("wrong.obj", "v 0 0 \\\n0\nv 1 0 0\nf 1 2 9\n")), Contains("wrong.obj:4"));
}

TEST_CASE("an STL may be written in capitals", "[shape]") {
    const TemporaryFolder folder;
    std::string text = "SOLID shape\n";
    for (const auto& polygon : triangulated(box_of_squares({-1, -1, -1}, {1, 1, 1})).polygons) {
        text += "FACET NORMAL 0 0 0\n OUTER LOOP\n";
        for (const std::uint32_t k : polygon)
            text += fmt::format("  VERTEX {} {} {}\n", k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
        text += " ENDLOOP\nENDFACET\n";
    }
    const auto box = shape_of(mesh_table(folder.write("box.stl", text + "ENDSOLID shape\n"), 0.05));
    CHECK(box->distance({0, 0, 2.5}) == Approx(1.5).epsilon(1e-6));
    CHECK_THAT(refusal_of(folder.write("cut.stl", text)), Contains("endsolid"));
}

TEST_CASE("voxels and sizes of a mesh are those of the scene, which `scale` makes of the file's", "[shape]") {
    const TemporaryFolder folder;
    TestMesh millimetres = unit_sphere(24);
    const std::string metres = folder.write("m.obj", text_of(millimetres)).string();
    for (glm::dvec3& point : millimetres.points) point *= 1000.0;
    const std::string file = folder.write("mm.obj", text_of(millimetres)).string();
    const auto scaled = shape_of(mesh_table(file, 0.05) + "\nscale = 0.001\ntranslate = [0.25, 0, 0]\n");
    const auto whole = shape_of(mesh_table(metres, 0.05) + "\ntranslate = [0.25, 0, 0]\n");
    CHECK(difference(*scaled, *whole) < 1e-4);
    CHECK_THAT(refusal_of(file, "voxel = 2e-5\nscale = 0.001"), Contains("GB") && Contains("2 m"));
}

TEST_CASE("a PLY with a point that is not a number, or cut short anywhere, is refused", "[shape]") {
    const TemporaryFolder folder;
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    const auto message = [&](const std::string& text) {
        write_text(folder.path() / "mesh.ply", text);
        return refusal_of(folder.path() / "mesh.ply");
    };
    CHECK(message(header + points + faces) == "accepted");
    CHECK_THAT(message(header + "0 0 0\n1 0 0\n0 nan 0\n0 0 1\n" + faces),
               Contains("point 3 of") && Contains("not finite"));
    CHECK_THAT(message(header + points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 7\n"), Contains("mesh.ply"));
    CHECK_THAT(message(header + points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 -2\n"), Contains("mesh.ply"));
    const std::string whole = header + points + faces;
    for (std::size_t length = 0; length + 3 < whole.size(); ++length) {
        INFO(length);
        REQUIRE_THAT(message(whole.substr(0, length)), Contains("mesh.ply"));
    }
}

TEST_CASE("a height field read from an image has the picture's rows along z", "[shape]") {
    const TemporaryFolder folder;
    write_png(folder.path() / "hill.png", 2, std::vector<std::uint8_t>{255, 255, 0, 0, 0, 0}, PNG_COLOR_TYPE_GRAY);
    const std::string table = "shape = 'height-field'\nlowest = 1\nhighest = 3\nsize = [1, 2]\nfile = '";
    const auto field = shape_of(table + (folder.path() / "hill.png").string() + "'");
    CHECK(field->inside({0.5, 2.9, 0.01}));
    CHECK_FALSE(field->inside({0.5, 1.1, 1.5}));
    CHECK(field->inside({0.5, 0.9, 1.5}));

    const std::string whole = read_text(folder.path() / "hill.png");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write_text(folder.path() / "cut.png", whole.substr(0, length));
        CHECK_THROWS_AS(shape_of(table + (folder.path() / "cut.png").string() + "'"), UserError);
    }
    write_text(folder.path() / "no.png", "no image");
    CHECK_THROWS_AS(shape_of(table + (folder.path() / "no.png").string() + "'"), UserError);
}

TEST_CASE("a mesh at places of a map keeps its inside, to a millimetre", "[shape]") {
    const TemporaryFolder folder;
    constexpr double east = 592783, north = -5432100;
    std::string cube;
    for (int k = 0; k < 8; ++k) cube += fmt::format("v {} {} {}\n", east + (k & 1), (k >> 1) & 1, north + (k >> 2));
    cube += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    const auto shape = shape_of(mesh_table(folder.write("cube.obj", cube), 0.05));
    const auto at = [](double x, double y, double z) { return glm::dvec3(east + x, y, north + z); };
    CHECK(shape->inside(at(0.5, 0.5, 0.5)));
    CHECK_FALSE(shape->inside(at(0.5, 0.5, 1.1)));
    CHECK(std::abs(shape->distance(at(0.5, 0.5, 0.9)) + 0.1) < 0.001);
    CHECK(std::abs(shape->distance(at(0.5, 0.5, 1.1)) - 0.1) < 0.001);
    CHECK(glm::distance(shape->sample(at(0.5, 0.97, 0.5)).nearest, at(0.5, 1, 0.5)) < 0.001);
}
