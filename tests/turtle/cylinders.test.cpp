// Generalized cylinders as strings write them; their geometry is tested where it is computed.
#include "catch.h"
#include "geometry/mesh_checks.h"
#include "turtle/drawing.h"

#include <memory>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// Volume of a tube of eight sides.
double tube(double width, double length) {
    return 8 / 2.0 * (width / 2) * (width / 2) * std::sqrt(0.5) * length;
}

double volume(const std::string& text) {
    Drawing drawing(text);
    const DrawnMesh& mesh = drawing.geometry().mesh;
    CHECK(EdgeCount(mesh).closed);
    return enclosed_volume(mesh);
}

/// The modules that the pieces belong to.
std::vector<std::uint32_t> modules_of(const DrawnMesh& mesh) {
    std::vector<std::uint32_t> modules;
    for (const MeshPiece& piece : mesh.pieces) modules.push_back(piece.module);
    return modules;
}

std::shared_ptr<Shapes> with_square() {
    auto shapes = std::make_shared<Shapes>();
    std::vector<glm::dvec3> corners;
    for (const glm::dvec3 corner :
         {glm::dvec3(1, 1, 0), glm::dvec3(-1, 1, 0), glm::dvec3(-1, -1, 0), glm::dvec3(1, -1, 0)}) {
        corners.insert(corners.end(), 3, corner);
    }
    shapes->contours.emplace(3, Contour(corners, true));
    shapes->textures.push_back({"bark.png", false, 4});
    return shapes;
}

}  // namespace

TEST_CASE("@Gs @Gc @Ge and the braces with a curve draw the same tube", "[turtle]") {
    const double expected = tube(0.5, 3);
    CHECK(volume("!(0.5)@Gsf@Gc(2)f(2)@Ge(3)") == Approx(expected));
    CHECK(volume("!(0.5){(1)f.(2)f(2).(3)}(1)") == Approx(expected));
    CHECK(volume("!(0.5){(1).(1)f.(2)f(2).(3)}(1)") == Approx(expected));
    CHECK(volume("!(0.5){(1,4)f(1)f(2)}(1)") == Approx(expected));  // the end of the braces is a point too
    CHECK(volume("!(0.5){(3)f.(2)f(2).(3)}(3)") == Approx(expected));
}

TEST_CASE("strips are those of the later control point, or of the braces, or one", "[turtle]") {
    const auto triangles = [](const std::string& text) {
        return Drawing(text).geometry().mesh.triangles.size() / 3 - 16;  // without the caps
    };
    CHECK(triangles("@Gsf@Gc(2)f@Ge(3)") == 5 * 16);
    CHECK(triangles("@Gsf@Gcf@Ge") == 2 * 16);
    CHECK(triangles("{(1,4)f.f.(2)}(1)") == 6 * 16);
    CHECK(triangles("@Gsf@Gc(-5)f@Ge(1e9)") == 1001 * 16);
}

TEST_CASE("the end of an F is a control point, which gives way to a marked one in its place", "[turtle]") {
    Drawing drawing("@GsFF@Gc(4)F@Ge(2)");
    const DrawnMesh& mesh = drawing.geometry().mesh;
    CHECK(modules_of(mesh) == std::vector<std::uint32_t>{3, 7, 11});  // F, Gc, Ge
    CHECK(mesh.triangles.size() / 3 == 16 + (1 + 4 + 2) * 16);
    CHECK(drawing.geometry().internodes.size() == 3);
    CHECK(Drawing("@GsGG@Ge(2)").geometry().mesh.pieces.size() == 1);  // G marks nothing
}

TEST_CASE("a width set after the start counts for the start", "[turtle]") {
    CHECK(volume("@Gs!(0.5)@Gc(1)f@Ge(1)") == Approx(tube(0.5, 1)));
}

TEST_CASE("two widths in one place make a step", "[turtle]") {
    CHECK(volume("!(1)@Gsf@Gc(1)!(0.5)@Gc(1)f@Ge(1)") == Approx(tube(1, 1) + tube(0.5, 1)));
    CHECK(volume("!(1)@Gsf@Gc(1)@Ge(1)") == Approx(tube(1, 1)));  // the same point twice is one
}

TEST_CASE("a marked point in a branch begins a tube of its own at the last point of the bearing axis", "[turtle]") {
    Drawing drawing("!(0.5)@Gsf@Gc(2)[+(90)!(0.2)f(2)@Gc(2)f@Ge(2)]f@Ge(2)");
    const DrawnMesh& mesh = drawing.geometry().mesh;
    REQUIRE(mesh.pieces.size() == 4);
    CHECK(EdgeCount(mesh, 0, 2).closed);  // apart, because they share a ring
    CHECK(EdgeCount(mesh, 2, 4).closed);
    // The branch ends first. Its points are at x = 0, -2, -3.
    double lowest = 0;
    for (std::uint32_t i = 0; i < mesh.pieces[1].count; ++i) {
        lowest = std::min(lowest, mesh.vertices[mesh.triangles[mesh.pieces[1].first + i]].position.x);
    }
    CHECK(lowest == Approx(-3));
    CHECK(mesh.pieces[0].order == 1);
    CHECK(mesh.pieces[3].order == 0);
    CHECK(drawing.geometry().bounds.upper.y == Approx(2));
}

TEST_CASE("what F draws in a branch is no part of the cylinder that bears it", "[turtle]") {
    Drawing drawing("@Gsf@Gc(2)[+FF{.F+F+F}]f@Ge(2)");
    CHECK(drawing.geometry().mesh.pieces.size() == 2);
    CHECK(drawing.geometry().internodes.size() == 5);
}

TEST_CASE("a branch may begin a cylinder of its own, and leaves the other one alone", "[turtle]") {
    CHECK(volume("!(0.5)@Gsf@Gc(1)[g(5)@Gsf(2)@Ge(1)]f@Ge(1)") == Approx(tube(0.5, 4)));
}

TEST_CASE("a cylinder that is not ended is drawn as far as it goes", "[turtle]") {
    CHECK(volume("!(0.5)@Gsf(2)@Gc(1)fA") == Approx(tube(0.5, 2)));
    CHECK(volume("!(0.5)[@Gsf(2)@Gc(1)]f@Gc(1)@Ge(1)") == Approx(tube(0.5, 2)));  // without one these mark nothing
    CHECK(volume("!(0.5)@Gsf@Gc(1)g(2)@Gsf(3)@Ge(1)") == Approx(tube(0.5, 4)));   // a second one ends the first
}

TEST_CASE("closed curves come back to their beginning", "[turtle]") {
    for (const char* text :
         {"!(0.2){(2)f.(4)+(90)f.(4)+(90)f.(4)+(90)}(2,4)", "!(0.2){(4).(4)f.(4)+(90)f.(4)+(90)f.(4)}(4,4)",
          "!(0.2){(2)f.(4)+(90)f.(4)+(90)f.(4)+(90)f.(4)}(2,4)"}) {
        INFO(text);
        Drawing drawing(text);
        const DrawnMesh& mesh = drawing.geometry().mesh;
        const EdgeCount edges(mesh);
        CHECK(edges.closed);
        CHECK(long(edges.places) - long(edges.edges) + long(edges.edges) * 2 / 3 == 0);  // a ring
        CHECK(mesh.pieces.size() == 4);
        CHECK(enclosed_volume(mesh) > 0.05);
    }
}

TEST_CASE("contours, sides, tangents and twist count from where they are set, and branches give them back",
          "[turtle]") {
    Drawing drawing("!(2)@#(3)@!(4)@Gsf(5)@Ge(1)[@#(0)@!(12)]f(9)@Gsf(5)@Ge(1)");
    drawing.settings.shapes = with_square();
    const double square =
        1 * 1 * 4 * 5;  // a square's corners (the contour turned onto the x axis) have unit distance 1 each
    const double each = enclosed_volume(drawing.geometry().mesh) / 2;
    CHECK(each > 0.4 * square);
    CHECK(each < 1.01 * square);
    CHECK(drawing.geometry().mesh.triangles.size() / 3 == 2 * (4 + 4 + 8));

    CHECK(Drawing("@!(2)@Gsf@Ge(1)").geometry().mesh.triangles.size() / 3 == 3 + 3 + 6);
    CHECK(Drawing("@!(1e9)@O").geometry().organs.at(0).sides == 256);
    CHECK(Drawing("[@!(5)]@O").geometry().organs.at(0).sides == 8);
    Drawing rolled("@Tf@Gsf/(90)@Ge(1)"), still("@Gsf/(90)@Ge(1)"), back("@Tf@Tp@Gsf/(90)@Ge(1)");
    // The last ring's first vertex points along up.
    const auto last_ring = [](Drawing& d) { return d.geometry().mesh.vertices[9 + 10].position; };
    CHECK(last_ring(rolled).x == Approx(0.5));
    CHECK(last_ring(still).z == Approx(-0.5));
    CHECK(last_ring(back).z == Approx(-0.5));
}

TEST_CASE("tangent factors bend a stretch more or less", "[turtle]") {
    // Up from (0, 0), down at (1, 0): in the middle at the height (T0 - T1) / 8, each tangent as long as its factor.
    const auto reach = [](const std::string& factors) {
        Drawing drawing(factors + "!(0)@Gs-(90)g(1)-(90)@Ge(10)");
        return drawing.geometry().bounds.upper.y;
    };
    CHECK(reach("") == Approx(1.2 / 4));
    CHECK(reach("@Gt(2)") == Approx(2.0 / 4));
    CHECK(reach("[@Gt(2)]") == Approx(1.2 / 4));
    CHECK(reach("@Gt(2,0)") < reach("@Gt(2)"));
}

TEST_CASE("a texture is kept with what it lies on, with its ratio along cylinders", "[turtle]") {
    Drawing drawing("@Tx(1)F!(1)@Gsf(2)@Ge(1){.f+f.}@O@Tx(0)F");
    drawing.settings.shapes = with_square();
    const PlantGeometry& geometry = drawing.geometry();
    CHECK(geometry.textures == std::vector<std::uint16_t>{1});
    CHECK(geometry.mesh.pieces.at(0).look.texture == 1);
    CHECK(geometry.polygons.at(0).look.texture == 1);
    CHECK(geometry.organs.at(0).look.texture == 1);
    CHECK(geometry.internodes.size() == 2);
    CHECK(geometry.mesh.vertices.at(9 + 10).uv.y == Approx(2 / 3.14159265358979 / 4));
}

TEST_CASE("strange cylinders draw what can be drawn and break nothing", "[turtle]") {
    for (const char* text :
         {"@Ge(3)", "@Gc", "@Gs@Ge", "@Gs@Gs@Gs", "}(1)", "{(1)}(1)", "{(2)f.}(2)", "[@Gs]@Ge", "@Gs[@Ge]@Gc",
          "@Gs[[@Gc]@Ge]", "{(1)[}]f.}", "{(0)f.f.f.}", "{(7).f.f.}", "@Gs@Ge[@Gc]", "{(1)f.[f.}(1)]f.}(1)",
          "@Gr(1)@Gr(30,1)@Gr(10,1,-10,1)@Gsf@Ge(3)", "@Gsf|@Gcf@Ge", "@#(99)@Gsf@Ge", "!(0)@Gsf@Ge"}) {
        INFO(text);
        Drawing drawing(text);
        for (const SurfaceVertex& vertex : drawing.geometry().mesh.vertices) {
            CHECK(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
            CHECK(glm::length(vertex.normal) == Approx(1));
        }
    }
    CHECK(Drawing("{(0)f.f.f.}").geometry().polygons.size() == 1);  // 0 is no curve
}

TEST_CASE("a cylinder that begins within a polygon has no point there for its branches to begin at", "[turtle]") {
    CHECK(volume("!(0.5){@Gs[f@Gcf(2)@Ge]") == Approx(tube(0.5, 2)));
    CHECK(Drawing("{@Gs[@Ge]").geometry().mesh.pieces.empty());
}

TEST_CASE("@Gm makes the cut of magnets, @Gf its flat middle, and @# goes back to contours", "[turtle]") {
    CHECK(volume("!(0.5)@Gm(1)@Gsf@Ge(1)") == Approx(tube(0.5, 1)));
    CHECK(volume("!(0.5)@Gm@Gsf@Ge(1)") == Approx(tube(0.5, 1)));
    CHECK(volume("!(0.5)@Gm(0.2,0,0,0)@Gsf@Ge(1)") == Approx(0.2 * tube(0.5, 1)));
    CHECK(volume("!(0.5)@Gm(1,1)@Gsf@Ge(1)") == Approx(4 * tube(0.5, 1)));
    CHECK(volume("!(0.5)@Gm(1,1)@#(0)@Gsf@Ge(1)") == Approx(tube(0.5, 1)));

    Drawing flat("!(0.5)@Gf(1)@Gsf@Ge(1)");
    const DrawnMesh& mesh = flat.geometry().mesh;
    CHECK(mesh.triangles.size() / 3 == 16);  // no caps
    for (const SurfaceVertex& vertex : mesh.vertices) {
        CHECK(vertex.position.z == Approx(0).margin(1e-12));  // up is -z
        CHECK(std::abs(vertex.position.x) <= 0.25 + 1e-12);
    }
}

TEST_CASE("between two cuts a cylinder changes evenly", "[turtle]") {
    CHECK(volume("!(0.5)@Gm(1,0)@Gsf@Gm(1,-0.5)@Ge(1)") == Approx(tube(0.5, 1) * (1 + 0.5 + 0.25) / 3));
}

TEST_CASE("a magnet that is not a number stops the drawing", "[turtle]") {
    Drawing drawing("@Gm(1,nan)@Gsf@Ge");
    CHECK_THROWS_WITH(drawing.draw(), Catch::Contains("strength"));
}
