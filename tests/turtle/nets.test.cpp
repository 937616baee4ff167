#include "catch.h"
#include "turtle/drawing.h"

using namespace espalier;

TEST_CASE("a net draws a surface between its rows, whose texture fills it once", "[turtle]") {
    Drawing drawing("@Nb(2)@Np[-(90)f(2)@Np]f(3)@Np[-(90)f(2)@Np]f(1)@Np[-(90)f(2)@Np]@Ne");
    const DrawnMesh& mesh = drawing.geometry().mesh;
    REQUIRE(mesh.vertices.size() == 6);
    CHECK(mesh.triangles.size() == 4 * 3);
    CHECK(mesh.pieces.at(0).kind == MeshPiece::Kind::patch);
    const std::array<glm::dvec2, 6> uvs{{{0, 0}, {1, 0}, {0, 0.5}, {1, 0.5}, {0, 1}, {1, 1}}};
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(mesh.vertices[k].uv == uvs[k]);
        CHECK(glm::distance(mesh.vertices[k].normal, glm::dvec3(0, 0, 1)) < 1e-12);  // rows to the right, upwards
    }
    CHECK(glm::distance(mesh.vertices[5].position, glm::dvec3(2, 4, 0)) < 1e-12);
}

TEST_CASE("points belong to the net begun last; rows that are not full are left out", "[turtle]") {
    Drawing drawing("@Nb(2)@Np[@Nb(2)@Np f(1)@Np@Ne]f(1)@Np f(1)@Np@Ne");
    CHECK(drawing.geometry().mesh.pieces.empty());
    CHECK(Drawing("@Np@Ne F(1)").geometry().internodes.size() == 1);
    CHECK_THROWS_WITH(Drawing("@Nb(1)").draw(), Catch::Contains("a net has two to a million columns"));
}
