// Background scenes from their text.
#include "espalier/turtle/background.h"

#include "catch.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;

namespace {

bool near_place(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-5;
}

Background background_of(const std::string& text, std::vector<Diagnostic>* found = nullptr) {
    Background background;
    std::vector<Diagnostic> diagnostics;
    read_background_text(text, "a.gls", Material{}, background, diagnostics);
    if (found) *found = diagnostics;
    if (!found) CHECK(diagnostics.empty());
    return background;
}

double volume_of(const Background& background) {
    double sum = 0;
    for (std::size_t i = 0; i < background.triangles.size(); i += 3) {
        const auto at = [&](std::size_t k) { return background.vertices[background.triangles[i + k]].position; };
        sum += glm::dot(at(0), glm::cross(at(1), at(2))) / 6;
    }
    return sum;
}

}  // namespace

TEST_CASE("transformations of a background apply before those that stand there", "[turtle]") {
    const std::string moved = "translate 10 0 0\nrotate 90 0 0 1\n";
    const std::string corner = "polygon 1 1 1 0 0 0 1 0 0\n";
    const Background background = background_of(moved + "pushmatrix multmatrix 1 0 0 0 0 2 0 0 0 0 3 0 5 6 7 1\n" +
                                                corner + "popmatrix\n" + corner);
    REQUIRE(background.vertices.size() == 6);
    CHECK(near_place(background.vertices[0].position, {2, 6, 10}));
    CHECK(near_place(background.vertices[5].position, {10, 1, 0}));
    CHECK(background.pieces.size() == 1);
}

TEST_CASE("solids of a background are closed, outside out, where and as large as they should be", "[turtle]") {
    CHECK(volume_of(background_of("box 2 3 4")) == Approx(24));
    CHECK(volume_of(background_of("prism 2 3 4")) == Approx(24));
    const double round =
        24 / (2 * std::acos(-1)) * std::sin(2 * std::acos(-1) / 24);  // area of a polygon of 24 sides over the circle's
    const double pi = std::acos(-1);
    CHECK(volume_of(background_of("cylinder 2 5")) == Approx(20 * pi * round));
    CHECK(volume_of(background_of("cone 2 0 3")) == Approx(4 * pi * round));
    CHECK(volume_of(background_of("sphere 1")) == Approx(4 * pi / 3).epsilon(0.03));
    CHECK(volume_of(background_of("scale 2 1 1 sphere 1")) == Approx(8 * pi / 3).epsilon(0.03));
    for (const char* solid : {"box 1 2 3", "cylinder 1 2", "cone 1 0.5 2", "sphere 1"}) {
        const Background background = background_of(std::string("rotate 30 1 2 3 scale 1 2 3 ") + solid);
        for (std::size_t i = 0; i < background.triangles.size(); i += 3) {
            const auto& a = background.vertices[background.triangles[i]];
            const auto& b = background.vertices[background.triangles[i + 1]];
            const auto& c = background.vertices[background.triangles[i + 2]];
            const glm::dvec3 across = glm::cross(b.position - a.position, c.position - a.position);
            for (const auto& vertex : {a, b, c}) CHECK(glm::dot(vertex.normal, across) >= -1e-12);
            CHECK(glm::length(a.normal) == Approx(1));
        }
    }
}

TEST_CASE("meshes and rectangles of a background have the normals their order gives", "[turtle]") {
    const Background mesh = background_of("mesh 0 0 0  0 0 1  1 0 0  1 0 1  2 0 0  2 0 1");
    CHECK(mesh.triangles.size() == 12);
    // (P3 - P0) x (P2 - P1) = (1, 0, 1) x (1, 0, -1)
    CHECK(near_place(mesh.vertices[0].normal, {0, 1, 0}));
    const Background rectangle = background_of("rectangle 2 3 5 7");
    CHECK(near_place(rectangle.vertices[0].position, {5, 7, 0}));
    CHECK(near_place(rectangle.vertices[2].position, {7, 10, 0}));
    CHECK(near_place(background_of("rectangle 2 3").vertices[0].position, {0, 0, 0}));
    const Background normals = background_of("polygonuv 0 0 0 0 3 0  1 0 0 0 3 0  0 0 1 0 3 0");
    CHECK(near_place(normals.vertices[1].normal, {0, 1, 0}));
    CHECK(near_place(background_of("polygon 0 0 0 1 0 0 0 1 0").vertices[0].normal, {0, 0, 1}));
}

TEST_CASE("a material of a background holds until the next, and only its complete groups count", "[turtle]") {
    std::vector<Diagnostic> found;
    const Background background = background_of(
        "sphere 1\n"
        "material 0.1 0.2 0.3 1  0.4 0.5 0.6 0.5  0 0 0 1  0 0 0 1  9\nsphere 1\n"
        "material 1 1 1\nmaterial 1 1 1 1 0.7\nsphere 1\n"
        "/* the end */ material 0 0 0 1\n",
        &found);
    CHECK(found.size() == 1);  // the material of three numbers
    REQUIRE(background.pieces.size() == 3);
    CHECK(background.pieces[0].material.diffuse == glm::dvec4(1));
    CHECK_FALSE(background.pieces[0].transparent());
    CHECK(background.pieces[1].material.shininess == 9);
    CHECK(background.pieces[1].transparent());
    CHECK(background.pieces[2].material.ambient == glm::dvec4(1));
    CHECK(background.pieces[2].material.diffuse.a == 0.5);
    CHECK(background.pieces[0].count + background.pieces[1].count + background.pieces[2].count ==
          background.triangles.size());
}

TEST_CASE("backgrounds may define macros, and commands that are unknown are told and passed over", "[turtle]") {
    std::vector<Diagnostic> found;
    const Background background = background_of(
        "#define SIZE 2 2 2\n"
        "matrixmode 1 loadidentity\n"
        "blob 1 2 3\n"
        "box SIZE\n"
        "cone 1\n"
        "popmatrix\n"
        "polygon 0 0 0, 1 1 1 2 2 2\n",
        &found);
    CHECK(volume_of(background) == Approx(8));
    REQUIRE(found.size() == 5);
    CHECK(to_string(found[0]) == "a.gls:3:1: background scenes have no command 'blob'\n    blob 1 2 3\n    ^");
    CHECK(found[1].message == "'cone' needs at least 3 numbers, not 1");
    CHECK(found[2].message == "no matrix was pushed that could be popped");
    CHECK(found[3].message == "'polygon' needs at least 9 numbers, not 3");
    CHECK(found[4].message == "background scenes have no command ','");
}
