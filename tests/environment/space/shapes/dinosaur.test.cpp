// The mesh of the topiary scene: made by the shapes themselves, and read back as a mesh.
#include "espalier/base/file.h"
#include "espalier/environment/shape.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/space/shapes/field.h"
#include "environment/space/shapes/tables.h"

#include <fmt/format.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cstdlib>
#include <cstring>

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::filesystem::path meshes = std::filesystem::path(ESPALIER_SOURCE_DIR) / "environments" / "meshes";

template <class T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// The surface of a recipe as a binary PLY of quadrilaterals and triangles.
std::string ply_of(const Shape& shape, double voxel) {
    const Box bounds = *shape.bounds();
    const auto field =
        sample_level_set(shape, {bounds.lower - 4 * voxel, bounds.upper + 4 * voxel}, voxel, std::size_t(1) << 30, {});
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*field->grid, points, triangles, quads);
    std::string ply = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment made from a recipe of shapes\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n",
        points.size(), triangles.size() + quads.size());
    for (const openvdb::Vec3s& point : points) {
        for (int i = 0; i < 3; ++i) append(ply, point[i]);
    }
    const auto append_face = [&](const auto& corners, int count) {
        append(ply, static_cast<std::uint8_t>(count));
        // OpenVDB winds its faces so that they look inward.
        for (int i = count - 1; i >= 0; --i) append(ply, static_cast<std::int32_t>(corners[i]));
    };
    for (const openvdb::Vec3I& triangle : triangles) append_face(triangle, 3);
    for (const openvdb::Vec4I& quad : quads) append_face(quad, 4);
    return ply;
}

}  // namespace

TEST_CASE("the dinosaur's mesh follows its recipe", "[shape]") {
    Settings recipe = Settings::read_toml(meshes / "dinosaur.toml");
    const double voxel = recipe.number("voxel");
    const auto dinosaur = read_shape(recipe);
    recipe.reject_unread();
    if (std::getenv("ESPALIER_WRITE_MESHES")) write_text(meshes / "dinosaur.ply", ply_of(*dinosaur, voxel));

    const auto mesh = shape_of(fmt::format("shape = 'mesh'\nfile = '{}'", (meshes / "dinosaur.ply").string()));
    int apart = 0, inside = 0;
    for (const glm::dvec3& point : random_points(20000, 6)) {
        const double distance = dinosaur->distance(point);
        inside += mesh->inside(point);
        // A mesh cuts edges, the feet's above all, within a voxel of it.
        apart += std::abs(distance) > voxel && mesh->inside(point) != (distance < 0);
    }
    CHECK(apart == 0);
    CHECK(inside > 100);
    CHECK(std::filesystem::file_size(meshes / "dinosaur.ply") < 1'000'000);
}

TEST_CASE("the dinosaur stands on the ground", "[shape]") {
    const auto mesh = shape_of(fmt::format("shape = 'mesh'\nfile = '{}'", (meshes / "dinosaur.ply").string()));
    const Box bounds = *mesh->bounds();
    CHECK(bounds.lower.y == Approx(0).margin(0.05));
    CHECK(bounds.upper.y == Approx(6).margin(0.1));
    CHECK(bounds.upper.x - bounds.lower.x == Approx(9).margin(0.3));
    CHECK_FALSE(mesh->inside({0, 0.5, 0}));  // between the legs
}
