// The fibres that a skeleton description develops into, as the turtle draws them.
#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/turtle/interpretation.h"

#include "catch.h"
#include "geometry/mesh_checks.h"
#include "language/sdl/skeleton.h"
#include "language/sdl/translation.h"

#include <numbers>

using namespace espalier;

namespace {

namespace sdl = language::sdl;
constexpr double pi = std::numbers::pi;

PlantGeometry drawn(const std::string& description, int generations = 0) {
    const std::string text = sdl::model_of(sdl::parse(description, "test.sdl"), "test.sdl").text;
    const std::shared_ptr<const Model> model = read_model_text(text, "test.sdl");
    Derivation derivation(compile(model), {});
    ModuleString string, next;
    derivation.start(string);
    for (int k = 0; k < generations; ++k) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return interpret(*model, string, {}, &derivation).geometry;
}

/// One upright component of length 2 with these functions.
DrawnMesh fibre(const std::string& functions, const std::string& type = "wooden") {
    return drawn("define{ a[0,2,0,0]; } rules{} fibres{ " + type + "{ " + functions + " } }").mesh;
}

/// The positions of ring k of a mesh whose rings have so many magnets. Behind the first ring of a solid one is its cap.
std::vector<glm::dvec3> ring(const DrawnMesh& mesh, int k, int magnets) {
    const bool has_caps = mesh.vertices.size() % std::size_t(magnets + 1) != 0;
    const int first = k * (magnets + 1) + (has_caps && k > 0 ? magnets + 2 : 0);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < magnets; ++i) points.push_back(mesh.vertices[std::size_t(first + i)].position);
    return points;
}

glm::dvec3 centre(const std::vector<glm::dvec3>& points) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& point : points) sum += point;
    return sum / double(points.size());
}

double area(const std::vector<glm::dvec3>& points) {
    glm::dvec3 sum(0);
    const glm::dvec3 middle = centre(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
        sum += glm::cross(points[k] - middle, points[(k + 1) % points.size()] - middle) / 2.0;
    }
    return glm::length(sum);
}

double from_axis(const glm::dvec3& point) {
    return std::hypot(point.x, point.z);
}

}  // namespace

TEST_CASE("without functions a fibre is a cylinder with an elliptic cut, as wide level as it is thick upright",
          "[sdl]") {
    const DrawnMesh mesh = fibre("cut[0.3, 0.1]; quality[2, 256];");
    CHECK(area(ring(mesh, 0, 256)) == Approx(pi * 0.15 * 0.05).epsilon(1e-3));
    CHECK(enclosed_volume(mesh) == Approx(2 * pi * 0.15 * 0.05).epsilon(1e-3));
    double widest = 0, thickest = 0;
    for (const glm::dvec3& point : ring(mesh, 1, 256)) {
        CHECK(point.y == Approx(2));
        thickest = std::max(thickest, std::abs(point.x));  // a fibre leans towards the x axis
        widest = std::max(widest, std::abs(point.z));
    }
    CHECK(thickest == Approx(0.05));
    CHECK(widest == Approx(0.15));
}

TEST_CASE("functions of no strength change nothing", "[sdl]") {
    const DrawnMesh plain = fibre("cut[0.2]; quality[5, 8];");
    const DrawnMesh same = fibre("cut[0.2]; quality[5, 8]; ring[0]; ring[0, 0, 0]; contour[0, 0]; correction[0, 5];");
    REQUIRE(plain.vertices.size() == same.vertices.size());
    for (std::size_t k = 0; k < plain.vertices.size(); ++k) {
        CHECK(glm::distance(plain.vertices[k].position, same.vertices[k].position) < 1e-9);
    }
}

TEST_CASE("a contour bends the axis along arcs and keeps the cut", "[sdl]") {
    const DrawnMesh mesh = fibre("cut[0.2, 0.1]; quality[7, 16]; contour[0, 40, -20];");
    const double cut = area(ring(mesh, 0, 16));
    glm::dvec3 expected(0);
    double angle = 0;
    const double turns[] = {0, 0, 20, 20, -10, -10};
    for (int k = 0; k <= 6; ++k) {
        CHECK(std::abs(area(ring(mesh, k, 16)) - cut) < 1e-6);
        CHECK(glm::distance(centre(ring(mesh, k, 16)), expected) < 1e-6);
        if (k == 6) break;
        constexpr int pieces = 20000;
        for (int i = 0; i < pieces; ++i) {
            const double heading = (angle + turns[k] * (i + 0.5) / pieces) * pi / 180;
            expected += glm::dvec3(std::sin(heading), std::cos(heading), 0) * (2.0 / 6 / pieces);
        }
        angle += turns[k];
    }
}

TEST_CASE("slaves begin on the bent axis of their master", "[sdl]") {
    const PlantGeometry geometry = drawn(
        "define{ a[0,2,30,10]; b[i / 6, 0, 0, 90]; } rules{ a -> (b*7); }"
        "fibres{ wooden a{ quality[7, 16]; contour[0, 40, -20]; } }",
        1);
    REQUIRE(geometry.internodes.size() == 7);
    for (int k = 0; k < 7; ++k) {
        CHECK(glm::distance(geometry.internodes[std::size_t(k)].base, centre(ring(geometry.mesh, k, 16))) < 1e-5);
    }
}

TEST_CASE("magnets move the outline of their ring, and rings blend along the fibre", "[sdl]") {
    const DrawnMesh mesh = fibre("cut[0.2]; quality[5, 8]; ring[0]; ring[0.5, 0, -0.5, 0]; ring[-1];");
    for (const glm::dvec3& point : ring(mesh, 0, 8)) CHECK(from_axis(point) == Approx(0.1));
    const auto middle = ring(mesh, 2, 8);
    CHECK(from_axis(middle[0]) == Approx(0.15));
    CHECK(middle[0].x == Approx(-0.15));  // above: away from where the fibre leans
    CHECK(from_axis(middle[2]) == Approx(0.1));
    CHECK(from_axis(middle[4]) == Approx(0.05));
    for (const glm::dvec3& point : ring(mesh, 4, 8)) CHECK(from_axis(point) == Approx(0).margin(1e-12));
    for (int k = 0; k < 4; ++k) CHECK(area(ring(mesh, k + 1, 8)) < area(ring(mesh, k, 8)) * 1.3);
}

TEST_CASE("corrections keep within their amplitude, have no direction and leave the mesh as it is knit", "[sdl]") {
    const DrawnMesh plain = fibre("cut[0.2]; quality[60, 32];");
    const DrawnMesh rough = fibre("cut[0.2]; quality[60, 32]; correction[0.2, 8];");
    REQUIRE(rough.triangles == plain.triangles);
    double sum = 0, most = 0;
    for (int k = 0; k < 60; ++k) {
        for (const glm::dvec3& point : ring(rough, k, 32)) {
            const double displacement = from_axis(point) - 0.1;
            sum += displacement;
            most = std::max(most, std::abs(displacement));
        }
    }
    CHECK(most <= 0.2 * 0.1 + 1e-12);
    CHECK(most > 0.3 * 0.2 * 0.1);
    CHECK(std::abs(sum) / (60 * 32) < 0.1 * 0.2 * 0.1);
}

TEST_CASE("flat fibres have no thickness, solid ones a volume", "[sdl]") {
    const std::string functions = "cut[0.2, 0.1]; ring[-0.3]; ring[0.2]; ring[-0.9]; contour[20, 30]; quality[7, 8];";
    const DrawnMesh flat = fibre(functions, "leaf"), solid = fibre("solid; " + functions, "leaf");
    CHECK(EdgeCount(solid).closed);
    CHECK(enclosed_volume(solid) > 0.001);
    CHECK_FALSE(EdgeCount(flat).closed);
    for (int k = 0; k < 6; ++k) {  // every cut is a level line
        const std::size_t first = std::size_t(k) * 9;
        for (std::size_t i = 1; i <= 8; ++i) {
            CHECK(flat.vertices[first + i].position.y == Approx(flat.vertices[first].position.y));
            CHECK(flat.vertices[first + i].position.x == Approx(flat.vertices[first].position.x).margin(1e-12));
        }
    }
}

TEST_CASE("wooden and leaf fibres have their own functions and materials, other components are lines", "[sdl]") {
    const PlantGeometry geometry = drawn(
        "define{ a[0,1,0,0]; b[1,0,0,20]; c[1,0,0,40]; } rules{ a -> (b c); }"
        "fibres{ wooden a{ quality[3, 6]; material[20]; } leaf b{ quality[4, 5]; material[40, 2]; } }",
        1);
    CHECK(geometry.internodes.size() == 1);
    std::map<int, std::size_t> triangles;
    for (const MeshPiece& piece : geometry.mesh.pieces) triangles[piece.colour] += piece.count / 3;
    CHECK(triangles == std::map<int, std::size_t>{{20, 2 * 12 + 2 * 6}, {40, 3 * 10}});
}

TEST_CASE("memory grows with rings and with magnets, and the error falls", "[sdl]") {
    const auto vertices = [](int rings, int magnets) {
        return fibre("quality[" + std::to_string(rings) + ", " + std::to_string(magnets) + "];", "leaf")
            .vertices.size();
    };
    for (const int rings : {2, 5, 40}) {
        for (const int magnets : {3, 8, 50}) CHECK(vertices(rings, magnets) == std::size_t(rings * (magnets + 1)));
    }
    const auto volume = [](int rings, int magnets) {
        return enclosed_volume(fibre("cut[0.2]; ring[0, 0.5, 0.2]; ring[0.5]; ring[-0.7, 0, 0.3]; quality[" +
                                     std::to_string(rings) + ", " + std::to_string(magnets) + "];"));
    };
    const double exact = volume(200, 256);
    double before = exact;
    for (const int quality : {5, 9, 17, 33}) {
        const double error = std::abs(volume(quality, 2 * quality) - exact);
        CHECK(error < before / 2);
        before = error;
    }
}
