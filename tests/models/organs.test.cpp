// Organs: surfaces from files, generalized cylinders, patches the L-system makes.
#include "espalier/geometry/palette.h"
#include "espalier/turtle/view_file.h"

#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <array>
#include <map>
#include <set>

using namespace espalier;

namespace {

// Grows a model of models/organs as its view file says.
LonePlant seen(const std::string& name, int steps, Defines defines = {}) {
    LonePlant plant("models/organs/" + name + ".l", std::move(defines));
    const View view = read_view_file(source_path("models/organs/" + name + ".v"));
    REQUIRE(view.diagnostics.empty());
    plant.turtle = view.turtle;
    plant.grow(steps);
    return plant;
}

// Edges of the triangles that have not exactly two of them, places nearer than 1e-9 counting as one.
int open_edges(const DrawnMesh& mesh) {
    std::map<std::array<long long, 3>, int> places;
    std::vector<int> place_of;
    for (const SurfaceVertex& vertex : mesh.vertices) {
        const std::array<long long, 3> key = {std::llround(vertex.position.x * 1e7),
                                              std::llround(vertex.position.y * 1e7),
                                              std::llround(vertex.position.z * 1e7)};
        place_of.push_back(places.emplace(key, static_cast<int>(places.size())).first->second);
    }
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = place_of[mesh.triangles[i + k]], b = place_of[mesh.triangles[i + (k + 1) % 3]];
            if (a != b) ++edges[std::minmax(a, b)];
        }
    }
    int open = 0;
    for (const auto& [edge, count] : edges) open += count == 2 ? 0 : 1;
    return open;
}

std::vector<glm::dvec3> places_of(const DrawnMesh& mesh) {
    std::vector<glm::dvec3> places;
    for (const SurfaceVertex& vertex : mesh.vertices) places.push_back(vertex.position);
    return places;
}

}  // namespace

TEST_CASE("flower: five sectors at 72 degrees, each with a sepal, a petal and a stamen of three lines", "[organs]") {
    LonePlant flower = seen("flower", 12);
    const PlantGeometry& geometry = flower.interpretation.geometry;
    std::vector<Organ> sepals, petals;
    for (const Organ& organ : geometry.organs) {
        REQUIRE(organ.shape == Organ::Shape::surface);
        (organ.surface == 's' ? sepals : petals).push_back(organ);
    }
    REQUIRE(sepals.size() == 5);
    REQUIRE(petals.size() == 5);
    CHECK(geometry.internodes.size() == 1 + 5 * 3);
    for (const auto* organs : {&sepals, &petals}) {
        for (std::size_t i = 1; i < 5; ++i) {
            const glm::dvec3 a = (*organs)[i - 1].pose.heading, b = (*organs)[i].pose.heading;
            CHECK(degrees_between({a.x, 0, a.z}, {b.x, 0, b.z}) == Approx(72));
        }
    }
    // Sepals lean out by 100 degrees, petals by 60; petals stand between the sepals.
    CHECK(degrees_between({0, 1, 0}, sepals[0].pose.heading) == Approx(100));
    CHECK(degrees_between({0, 1, 0}, petals[0].pose.heading) == Approx(60));
    const glm::dvec3 sepal = sepals[0].pose.heading, petal = petals[0].pose.heading;
    CHECK(degrees_between({sepal.x, 0, sepal.z}, {petal.x, 0, petal.z}) == Approx(36));
}

TEST_CASE("flower: a surface's frame is the turtle's where it stands", "[organs]") {
    LonePlant flower = seen("flower", 12);
    for (const Organ& organ : flower.interpretation.geometry.organs) {
        const Pose& pose = organ.pose;
        CHECK(glm::distance(pose.position, glm::dvec3(0, 0.08, 0)) < 1e-12);
        CHECK(glm::distance(glm::cross(pose.left, pose.heading), pose.up) < 1e-12);
        CHECK(glm::length(pose.heading) == Approx(1));
        CHECK(std::abs(glm::dot(pose.heading, pose.left)) < 1e-12);
    }
    // The first sepal: the turtle pitched down by 100 degrees from its start.
    const double angle = 100 * std::numbers::pi / 180;
    const Pose& first = flower.interpretation.geometry.organs[0].pose;
    CHECK(glm::distance(first.heading, glm::dvec3(0, std::cos(angle), -std::sin(angle))) < 1e-12);
    CHECK(glm::distance(first.left, glm::dvec3(-1, 0, 0)) < 1e-12);
}

TEST_CASE("shoot: one leaf a step at 137.5 degrees, growing to its full size", "[organs]") {
    LonePlant shoot = seen("shoot", 16);
    const auto& organs = shoot.interpretation.geometry.organs;
    REQUIRE(organs.size() == 16);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const double age = std::min(10.0, 15.0 - static_cast<double>(i));
        CHECK(organs[i].size.x == Approx(2 * (age + 0.1) / 10));
        if (i == 0) continue;
        const glm::dvec3 a = organs[i - 1].pose.heading, b = organs[i].pose.heading;
        CHECK(degrees_between({a.x, 0, a.z}, {b.x, 0, b.z}) == Approx(137.5));
    }
}

TEST_CASE("trunk: a closed mesh as wide as the turtle's line, and round with contour 0", "[organs]") {
    LonePlant fluted = seen("trunk", 9);
    LonePlant round = seen("trunk", 9, {{"CONTOUR", "0"}});
    for (LonePlant* trunk : {&fluted, &round}) {
        const DrawnMesh& mesh = trunk->interpretation.geometry.mesh;
        CHECK(mesh.pieces.size() == 9);
        CHECK(open_edges(mesh) == 0);
    }
    // The foot is a ring of radius 1.2 about the origin, or of the contour's own radii there.
    const auto foot_radii = [](const LonePlant& trunk) {
        std::vector<double> radii;
        for (const glm::dvec3& place : places_of(trunk.interpretation.geometry.mesh)) {
            const double radius = glm::length(place);
            if (std::abs(place.y) < 1e-6 && radius > 0.01) radii.push_back(radius);
        }
        return radii;
    };
    for (double radius : foot_radii(round)) CHECK(radius == Approx(1.2).epsilon(1e-6));
    const std::vector<double> radii = foot_radii(fluted);
    REQUIRE(radii.size() >= 48);
    CHECK(*std::max_element(radii.begin(), radii.end()) > 1.1 * *std::min_element(radii.begin(), radii.end()));
}

TEST_CASE("horn: the heading turns alike at every point, and the mesh closes and shrinks", "[organs]") {
    LonePlant horn("models/organs/horn.l", {{"POINTS", "20"}});
    horn.grow(20);
    const DrawnMesh& mesh = horn.interpretation.geometry.mesh;
    REQUIRE(mesh.pieces.size() == 20);
    CHECK(open_edges(mesh) == 0);
    // Middle of each stretch: steps between them shrink by the ratio.
    std::vector<glm::dvec3> middles;
    for (const MeshPiece& piece : mesh.pieces) {
        glm::dvec3 sum(0);
        for (std::uint32_t i = 0; i < piece.count; ++i) sum += mesh.vertices[mesh.triangles[piece.first + i]].position;
        middles.push_back(sum / double(piece.count));
    }
    for (std::size_t i = 4; i < 18; ++i) {
        const double before = glm::distance(middles[i - 2], middles[i - 1]),
                     after = glm::distance(middles[i - 1], middles[i]);
        CHECK(after / before == Approx(0.94).epsilon(0.01));
    }
    // Without roll it stays in a plane.
    LonePlant flat("models/organs/horn.l", {{"POINTS", "20"}, {"ROLL", "0"}});
    flat.grow(20);
    double depth = 0;
    for (const glm::dvec3& place : places_of(flat.interpretation.geometry.mesh))
        depth = std::max(depth, std::abs(place.z));
    CHECK(depth <= 0.6 + 1e-9);
}

TEST_CASE("patch-leaf: the patch begins at the stalk, is symmetric and grows with age", "[organs]") {
    double length = 0, width = 0;
    for (int step : {3, 6, 12}) {
        LonePlant leaf("models/organs/patch-leaf.l");
        leaf.grow(step);
        const DrawnMesh& mesh = leaf.interpretation.geometry.mesh;
        REQUIRE(mesh.pieces.size() == 1);
        CHECK(mesh.pieces[0].kind == MeshPiece::Kind::patch);
        CHECK(mesh.pieces[0].count == 8 * 8 * 2 * 3);
        const std::vector<glm::dvec3> places = places_of(mesh);
        double left = 0, right = 0, end = 0, begin = 1e9;
        for (const glm::dvec3& place : places) {
            left = std::min(left, place.x);
            right = std::max(right, place.x);
            end = std::max(end, place.y);
            begin = std::min(begin, place.y);
            const bool mirrored = std::any_of(places.begin(), places.end(), [&](const glm::dvec3& other) {
                return glm::distance(glm::dvec3(-place.x, place.y, place.z), other) < 1e-9;
            });
            CHECK(mirrored);
        }
        CHECK(begin == Approx(1));
        CHECK(right - left > width);
        CHECK(end - 1 > length);
        width = right - left;
        length = end - 1;
    }
}

TEST_CASE("plants.map: the indices of the models look like bark, leaves and petals", "[organs]") {
    Palette palette;
    read_colour_map(source_path("models/plants.map"), 1, palette);
    CHECK(palette.entries.size() == 256);
    const glm::dvec4 leaf = palette.material(40).diffuse, bark = palette.material(128).diffuse;
    CHECK(leaf.g > 2 * leaf.r);
    CHECK(leaf.g > 2 * leaf.b);
    CHECK((bark.r > bark.g && bark.g > bark.b));
    const glm::dvec4 ray = palette.material(160).diffuse, petal = palette.material(200).diffuse;
    CHECK(std::min(ray.r, ray.g) > 2 * ray.b);
    CHECK(petal.r > petal.g);
}
