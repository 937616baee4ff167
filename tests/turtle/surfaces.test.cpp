#include "catch.h"
#include "turtle/drawing.h"

#include <memory>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// A patch spanned by left and heading, one unit wide, two long; the turtle goes on at its tip.
std::shared_ptr<Shapes> with_leaf() {
    auto shapes = std::make_shared<Shapes>();
    Surface leaf;
    BicubicPatch patch;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) patch.points[i][j] = {(j - 1.5) / 3, 2.0 * i / 3, i == 3 ? 0.5 : 0};
    }
    leaf.patches.push_back(patch);
    leaf.end = {0.5, 2, 0.25};
    shapes->surfaces['l'] = leaf;
    Surface triangle;
    triangle.triangles.push_back({SurfaceVertex{{0, 0, 0}, {0, 0, 1}, {}}, SurfaceVertex{{1, 0, 0}, {0, 0, 1}, {}},
                                  SurfaceVertex{{0, 1, 0}, {0, 0, 1}, {}}});
    triangle.texture = 0;
    shapes->surfaces['t'] = triangle;
    return shapes;
}

Drawing leafy(const std::string& text) {
    Drawing drawing(text);
    drawing.settings.shapes = with_leaf();
    return drawing;
}

}  // namespace

TEST_CASE("a surface is an organ at the turtle's pose, and the turtle goes to its end point", "[turtle]") {
    // position + g (a x L + b y H + c z U), and the end point with the first factor alone.
    const glm::dvec3 end(-0.5, 2, -0.25);  // in the first frame L = -x, H = y, U = -z
    CHECK(leafy("~l").pose().position == end);
    CHECK(leafy("~l(2)").pose().position == 2.0 * end);
    CHECK(leafy("~l(2,7)").pose().position == 2.0 * end);
    CHECK(leafy("~l(2,3,5)").pose().position == 2.0 * end);
    CHECK(leafy("@D(3)~l(2)").pose().position == 6.0 * end);
    CHECK(leafy("!(9)~l").pose().position == end);  // the width does not enter
    CHECK(leafy("+(90)~l").pose().position.x == Approx(-2));
    CHECK(leafy("+(31)~l").pose().heading == pose_after("+(31)").heading);

    Drawing drawing = leafy("F@D(2)~l(2,3,5)");
    const Organ& organ = drawing.geometry().organs.at(0);
    CHECK(organ.size == glm::dvec3(4, 6, 10));
    CHECK(organ.pose.position == glm::dvec3(0, 1, 0));
    CHECK(organ.surface == 'l');
}

TEST_CASE("one or two factors count for all three directions", "[turtle]") {
    CHECK(leafy("~l(2,7)").geometry().organs.at(0).size == glm::dvec3(2));
    CHECK(leafy("~l").geometry().organs.at(0).size == glm::dvec3(1));
}

TEST_CASE("with a factor of zero nothing is drawn, but the turtle goes on", "[turtle]") {
    CHECK(leafy("~l(0)").geometry().organs.empty());
    CHECK(leafy("~l(0)").pose().position == glm::dvec3(0));
    CHECK(leafy("~l(2,0,1)").geometry().organs.empty());
    CHECK(leafy("~l(2,0,1)").pose().position.y == 4);
}

TEST_CASE("a surface nobody described is a rhombus without a view file, and nothing with one", "[turtle]") {
    CHECK(leafy("~x").geometry().organs.empty());
    CHECK(leafy("~x").pose().position == glm::dvec3(0));
    CHECK(Drawing("~x").geometry().organs.size() == 1);
    CHECK(pose_after("~x").position == glm::dvec3(0));
}

TEST_CASE("triangles are drawn and the turtle stays", "[turtle]") {
    Drawing drawing = leafy("@Tx(1)~t(3)F~l");
    CHECK(drawing.pose().position.y == 3);
    CHECK(drawing.geometry().organs.at(0).look.texture == 0);  // never textured
    CHECK(drawing.geometry().organs.at(1).look.texture == 1);
    CHECK(drawing.geometry().axes == 1);
}

TEST_CASE("the bounds contain a surface's control points", "[turtle]") {
    Drawing drawing = leafy("~l(2)");
    const Box& bounds = drawing.geometry().bounds;
    CHECK(bounds.lower.x == Approx(-1));
    CHECK(bounds.upper.x == Approx(1));
    CHECK(bounds.upper.y == Approx(4));
    CHECK(bounds.lower.z == Approx(-1));
}

TEST_CASE("an axis goes on after a surface that leads somewhere as a new one", "[turtle]") {
    CHECK(leafy("F~lF").geometry().axes == 2);
    CHECK(leafy("F~tF").geometry().axes == 1);
}

TEST_CASE("a patch's control points are positions of the turtle, counted from 0 or from 1", "[turtle]") {
    const auto grid = [](int first) {
        std::string text = "@PS(7,2)";
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                text += "[@M(" + std::to_string(i) + "," + std::to_string(j) + ")@PC(7," + std::to_string(i + first) +
                        "," + std::to_string(j + first) + ")]";
            }
        }
        return text + "@PD(7,2,3)";
    };
    for (const int first : {0, 1}) {
        Drawing drawing(";(9)" + grid(first));
        const PlantGeometry& geometry = drawing.geometry();
        REQUIRE(geometry.mesh.pieces.size() == 1);
        CHECK(geometry.mesh.pieces[0].kind == MeshPiece::Kind::patch);
        CHECK(geometry.mesh.pieces[0].colour == 9);
        CHECK(geometry.mesh.pieces[0].module == drawing.string.size() - 1);
        CHECK(geometry.mesh.vertices.size() == 3 * 4);
        CHECK(geometry.mesh.triangles.size() == 2 * 3 * 6);
        // A B-spline over a plane grid covers its middle, with rows along s.
        CHECK(glm::distance(geometry.mesh.vertices[0].position, {1, 1, 0}) < 1e-14);
        CHECK(glm::distance(geometry.mesh.vertices[3].position, {1, 2, 0}) < 1e-14);
        CHECK(glm::distance(geometry.mesh.vertices[11].position, {2, 2, 0}) < 1e-14);
        CHECK(geometry.mesh.vertices[5].normal == glm::dvec3(0, 0, 1));
        CHECK(geometry.bounds.upper.x == Approx(2));
    }
}

TEST_CASE("a patch's points that were never visited lie where it was begun; unknown patches draw nothing", "[turtle]") {
    Drawing drawing("F@PS(1)[F@PC(1,3,3)]@PD(1)");
    const PlantGeometry& geometry = drawing.geometry();
    CHECK(geometry.mesh.vertices.size() == 36);
    CHECK(geometry.mesh.vertices.front().position == glm::dvec3(0, 1, 0));
    CHECK(geometry.mesh.vertices.back().position == glm::dvec3(0, 2, 0));
    for (const char* text : {"@PD(1,2,2)", "@PC(1,0,0)@PD(1,2,2)", "@PS@PD", "@PS(1)@PD(2,1,1)"}) {
        INFO(text);
        CHECK(Drawing(text).geometry().mesh.pieces.empty());
    }
    CHECK(Drawing("@PS(1)@PC(1,9,-1)@PD(1,1e9,-4)").geometry().mesh.vertices.size() == 65 * 2);
}
