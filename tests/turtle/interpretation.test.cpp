#include "espalier/turtle/interpretation.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "turtle/drawing.h"

#include <cmath>
#include <cstring>
#include <string>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// `F` replaced by the Koch generator, n times.
std::string koch(int n) {
    std::string text = "F";
    for (int step = 0; step < n; ++step) {
        std::string next;
        for (const char symbol : text) next += symbol == 'F' ? std::string("F+F--F+F") : std::string(1, symbol);
        text = next;
    }
    return text;
}

Drawing koch_drawing(int n) {
    Drawing drawing("-(90)" + koch(n));  // heading +x
    drawing.settings.angle = std::acos(0.5);
    return drawing;
}

bool same(const Interpretation& a, const Interpretation& b) {
    const PlantGeometry &g = a.geometry, &h = b.geometry;
    return g.internodes.size() == h.internodes.size() && g.axes == h.axes && g.vertices == h.vertices &&
           g.organs.size() == h.organs.size() && g.bounds.lower == h.bounds.lower && g.bounds.upper == h.bounds.upper &&
           a.queries.size() == b.queries.size() && a.answers.size() == b.answers.size() &&
           std::equal(g.internodes.begin(), g.internodes.end(), h.internodes.begin(),
                      [](const Internode& s, const Internode& t) { return s.tip == t.tip && s.axis == t.axis; });
}

std::string message_of(const std::string& text) {
    try {
        Drawing(text).draw();
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("the Koch generator of step 1 ends at (3, 0)", "[turtle]") {
    Drawing drawing = koch_drawing(1);
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.internodes.size() == 4);
    CHECK(glm::length(geometry.internodes.back().tip - glm::dvec3(3, 0, 0)) < 1e-14);
    CHECK(geometry.internodes[1].tip.y == Approx(std::sqrt(3) / 2));  // + turns left, upwards
}

TEST_CASE("the Koch curve has 4^n segments and ends at 3^n", "[turtle]") {
    for (const int n : {0, 2, 3, 5}) {
        Drawing drawing = koch_drawing(n);
        const PlantGeometry& geometry = drawing.geometry();
        CHECK(geometry.internodes.size() == std::size_t(std::pow(4, n)));
        CHECK(total_length(geometry) == Approx(std::pow(4, n)));
        // Its length relative to its base is (4/3)^n.
        CHECK(total_length(geometry) / glm::length(geometry.internodes.back().tip) == Approx(std::pow(4.0 / 3, n)));
    }
}

TEST_CASE("F and G draw their length times the scale, f and g only move", "[turtle]") {
    Drawing drawing("F(2.5)f(1)G(0.5)g@D(2)F(3)");
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.internodes.size() == 3);
    CHECK(geometry.internodes[0].tip.y == 2.5);
    CHECK(geometry.internodes[1].base.y == 3.5);
    CHECK(geometry.internodes[1].tip.y == 4);
    CHECK(geometry.internodes[2].base.y == 5);
    CHECK(geometry.internodes[2].tip.y == 11);
    CHECK(geometry.internodes[2].module == 6);
}

TEST_CASE("the bracketed example has 8 segments on three orders", "[turtle]") {
    Drawing drawing("F[+F][-F[-F]F]F[+F][-F]");
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.internodes.size() == 8);
    std::vector<int> of_order(3);
    for (const Internode& internode : geometry.internodes) ++of_order.at(internode.order);
    CHECK(of_order == std::vector<int>{2, 5, 1});  // 4 first-order branches, one of them of two segments
    CHECK(geometry.axes == 6);
    CHECK(geometry.internodes[0].axis == geometry.internodes[5].axis);  // the trunk goes on after its branches
    CHECK(geometry.internodes[2].axis == geometry.internodes[4].axis);
    CHECK(geometry.internodes[1].axis != geometry.internodes[2].axis);
}

TEST_CASE("a branch leaves no trace in the turtle's state, bit for bit", "[turtle]") {
    const std::string before = "+(33)F(0.7)&(21)!(0.3);(5)@;(7)@D(1.3)/(77)F";
    Drawing plain(before + "?E(1)"), branched(before + "[-(12)F@D(2)!(9);;@;|^(3)[f\\(1)]@M(1,2,3)@R(1,1)]?E(1)");
    const Query one = plain.draw().queries.back(), other = branched.draw().queries.back();
    CHECK(std::memcmp(&one.pose, &other.pose, sizeof(Pose)) == 0);
    CHECK(one.width == other.width);
    CHECK(one.scale == other.scale);

    Drawing continued(before + "[-(12)F;(1)]F"), straight(before + "F");
    const Internode after = continued.geometry().internodes.back(), without = straight.geometry().internodes.back();
    CHECK(after.tip == without.tip);
    CHECK(after.colour == without.colour);
    CHECK(after.axis == without.axis);
    CHECK(after.base_radius == without.base_radius);
}

TEST_CASE("a million nested branches are drawn and closed", "[turtle]") {
    const int depth = 1'000'000;
    Drawing drawing("F");
    const LetterId F = *drawing.model.alphabet.find("F", 0);
    for (int i = 0; i < depth; ++i) drawing.string.append(Alphabet::open_bracket);
    drawing.string.append(F);
    for (int i = 0; i < depth; ++i) drawing.string.append(Alphabet::close_bracket);
    drawing.string.append(F);
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.internodes.size() == 3);
    CHECK(geometry.internodes[1].order == 65535);
    CHECK(geometry.internodes[2].order == 0);
    CHECK(geometry.internodes[2].tip.y == 2);
    CHECK(geometry.axes == 2);
}

TEST_CASE("a new axis begins after a bracket and after a jump", "[turtle]") {
    Drawing drawing("FF[F]FfFgF@M(0,0)F+F");
    std::vector<std::uint32_t> axes;
    for (const Internode& internode : drawing.geometry().internodes) axes.push_back(internode.axis);
    CHECK(axes == std::vector<std::uint32_t>{0, 0, 1, 0, 2, 3, 4, 4});
}

TEST_CASE("a walk that nothing interrupts draws the same as one with an action behind each letter, bit for bit",
          "[turtle]") {
    std::string whole, interrupted;
    for (int k = 0; k < 20; ++k) {
        for (const char* letter : {"f(0.5)", "F(1)", "[", "+(30)", "!(0.3)", "G(2)", "g(0.25)", "F(0.5)", "]", "/(40)",
                                   "F", "f", "&(20)", "F(0.1)"}) {
            whole += letter;
            interrupted += std::string(letter) + "?";
        }
    }
    Drawing in_one(whole), piece_by_piece(interrupted);
    const auto& ones = in_one.geometry().internodes;
    const auto& others = piece_by_piece.geometry().internodes;
    REQUIRE(ones.size() == 100);
    REQUIRE(others.size() == 100);
    int different = 0;
    for (std::size_t i = 0; i < ones.size(); ++i) {
        const Internode &a = ones[i], &b = others[i];
        different += a.base != b.base || a.tip != b.tip || a.axis != b.axis || a.order != b.order ||
                     a.base_radius != b.base_radius || a.tip_radius != b.tip_radius || 2 * a.module != b.module;
    }
    CHECK(different == 0);
    CHECK(in_one.pose().position == piece_by_piece.pose().position);
}

TEST_CASE("internodes taper from the width before them, the first of an axis does not", "[turtle]") {
    Drawing drawing("!(4)F!(2)F[!(1)F!(0.5)F]!(1)F");
    const auto& internodes = drawing.geometry().internodes;
    REQUIRE(internodes.size() == 5);
    const double radii[5][2] = {{2, 2}, {2, 1}, {0.5, 0.5}, {0.5, 0.25}, {1, 0.5}};
    for (int i = 0; i < 5; ++i) {
        CHECK(internodes[i].base_radius == radii[i][0]);
        CHECK(internodes[i].tip_radius == radii[i][1]);
    }
}

TEST_CASE("after k narrowings the width is w - k d, and never below its floor", "[turtle]") {
    Drawing drawing("F!F!F#F!!!F!!!!!F");
    drawing.settings.line_width = 1;
    drawing.settings.line_width_increment = 0.25;
    std::vector<double> widths;
    for (const Internode& internode : drawing.geometry().internodes) widths.push_back(internode.tip_radius * 2);
    CHECK(widths == std::vector<double>{1, 0.75, 0.5, 0.75, 1e-7, 1e-7});
}

TEST_CASE("a width given as parameter counts in units of the scale", "[turtle]") {
    Drawing drawing("@D(0.5)!(3)F#(2)F");
    CHECK(drawing.geometry().internodes[0].tip_radius == 0.75);
    CHECK(drawing.geometry().internodes[1].tip_radius == 0.5);
}

TEST_CASE("the scale is set, multiplied and divided", "[turtle]") {
    const auto length = [](const std::string& text) { return total_length(Drawing(text + "F").geometry()); };
    CHECK(length("@D(3)") == 3);
    CHECK(length("@D(3)@Di(2)") == 6);
    CHECK(length("@D(3)@Dd(2)") == 1.5);
    CHECK(length("@D(3)[@Di(2)]") == 3);
    CHECK(length("@D") == 1);
    Drawing drawing("@Di@Di@DdF");
    drawing.settings.scale_multiplier = 3;
    CHECK(total_length(drawing.geometry()) == 3);
}

TEST_CASE("colour indices wrap within their map of 256", "[turtle]") {
    const auto colour = [](const std::string& text, int start) {
        Drawing drawing(text + "F");
        drawing.settings.colour = start;
        return int(drawing.geometry().internodes.back().colour);
    };
    CHECK(colour("", 128) == 128);
    CHECK(colour(";;,", 128) == 129);
    CHECK(colour(";", 255) == 0);
    CHECK(colour(",", 0) == 255);
    CHECK(colour(";(300)", 0) == 44);
    CHECK(colour(",(-1)", 0) == 255);
    CHECK(colour(";", 511) == 256);  // the second map
    CHECK(colour("[;;]", 3) == 3);
    CHECK(colour("@;@;(9)@,", 3) == 3);
}

TEST_CASE("the traced leaf is a closed plane polygon with a mirror", "[turtle]") {
    Drawing drawing("{-f+f+f-|-f+f+f}");
    drawing.settings.angle = 22.5 * 3.14159265358979323846 / 180;
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.polygons.size() == 1);
    REQUIRE(geometry.polygons[0].count == 6);
    const std::vector<glm::dvec3>& v = geometry.vertices;
    CHECK(glm::length(v[5]) < 1e-14);  // back where it began
    for (const glm::dvec3& vertex : v) CHECK(vertex.z == 0);
    // The mirror is the line from the base to the tip (vertex 2).
    const glm::dvec3 axis = glm::normalize(v[2]);
    const auto mirrored = [&](const glm::dvec3& point) { return axis * (2 * glm::dot(point, axis)) - point; };
    CHECK(glm::length(mirrored(v[0]) - v[4]) < 1e-14);
    CHECK(glm::length(mirrored(v[1]) - v[3]) < 1e-14);
    CHECK(geometry.internodes.empty());
}

TEST_CASE("polygons nest, and G and g mark no vertex", "[turtle]") {
    Drawing drawing("{.f+(90)f{.G+(90)F+(90).f}+(90)g.}");
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.polygons.size() == 2);
    CHECK(geometry.polygons[0].count == 3);  // the inner one is finished first
    CHECK(geometry.polygons[1].count == 3);
    CHECK(geometry.polygons[0].module == 5);
    CHECK(geometry.polygons[1].module == 0);
    CHECK(geometry.vertices.size() == 6);
}

TEST_CASE("a point behind a step marks the vertex that the step marked", "[turtle]") {
    const PlantGeometry leaf = Drawing("{.+(30)f(0.5).-(60)f(0.5).-(120)f(0.5).}").geometry();
    REQUIRE(leaf.polygons.size() == 1);
    CHECK(leaf.polygons[0].count == 4);
    const PlantGeometry closed = Drawing("{.+(30)f(0.5).-(60)f(0.5).-(120)f(0.5).-(60)f(0.5).}").geometry();
    CHECK(closed.polygons.at(0).count == 4);  // it comes back to its first vertex, but for rounding
}

TEST_CASE("the colour of a polygon is that of its first vertex", "[turtle]") {
    Drawing drawing(";(2){;(3).f(1)+(90)f(1)+(90)f(1);(7)}F");
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.polygons.size() == 1);
    CHECK(geometry.polygons[0].colour == 3);
    CHECK(geometry.polygons[0].look.back_colour == 3);
    CHECK(geometry.internodes[0].colour == 7);
}

TEST_CASE("a line that nobody gave a width has no radius, and one pixel", "[turtle]") {
    Drawing drawing("F[!(0.2)F]F!F#F");
    drawing.settings.line_width.reset();
    const auto& lines = drawing.geometry().internodes;
    for (const std::size_t i : {0, 2, 3, 4}) {
        CHECK(lines[i].base_radius == 0);
        CHECK(lines[i].tip_radius == 0);
        CHECK(lines[i].pixels == 1);
    }
    CHECK(lines[1].tip_radius == Approx(0.1));
    CHECK(lines[1].pixels == 0);
    CHECK(drawing.geometry().bounds.upper.x == Approx(0.1));
}

TEST_CASE("a width given on the way tapers from nothing, and a sub-system gives none", "[turtle]") {
    Drawing drawing("?(1,2)F$F!(0.2)F");
    drawing.settings.line_width.reset();
    const auto& lines = drawing.geometry().internodes;
    CHECK(lines[0].tip_radius == 0);
    CHECK(lines[1].tip_radius == 0);
    CHECK(lines[2].base_radius == 0);
    CHECK(lines[2].tip_radius == Approx(0.1));
}

TEST_CASE("a polygon reaches across branches", "[turtle]") {
    Drawing drawing("[+(30)F{.]F.[-(30)F.}]");  // ABOP's framework leaf ties marked points of several branches
    const PlantGeometry& geometry = drawing.geometry();
    REQUIRE(geometry.polygons.size() == 1);
    REQUIRE(geometry.polygons[0].count == 3);
    CHECK(geometry.vertices[0].x == Approx(-0.5));
    CHECK(geometry.vertices[1].y == 1);
    CHECK(geometry.vertices[2].x == Approx(0.5));
}

TEST_CASE("unfinished, unopened and too small polygons draw nothing", "[turtle]") {
    for (const char* text : {"{.f.f.", ".f.f.}", "{.f}", "{}", "}}{", "{(1).f.f.}(1)"}) {
        INFO(text);
        CHECK(Drawing(text).geometry().polygons.empty());
    }
    CHECK(Drawing("{.f.{(1)ff}.+f.}").geometry().polygons.at(0).count == 4);  // a cylinder's points do not count
}

TEST_CASE("discs, spheres and outlines have a diameter, by default the line width", "[turtle]") {
    Drawing drawing("F(2)+(90)@o(3)@c@O(2)@bo(1)@bc(4)~a~b(2)~c(1,2,3)");
    drawing.settings.line_width = 0.5;
    const std::vector<Organ>& organs = drawing.geometry().organs;
    REQUIRE(organs.size() == 8);
    using enum Organ::Shape;
    const Organ::Shape shapes[] = {disc, disc, sphere, circle, circle, surface, surface, surface};
    const double sizes[] = {3, 0.5, 2, 1, 4, 1, 2, 1};
    for (int i = 0; i < 8; ++i) {
        CHECK(organs[i].shape == shapes[i]);
        CHECK(organs[i].size.x == sizes[i]);
        CHECK(organs[i].pose.position == glm::dvec3(0, 2, 0));
    }
    CHECK(organs[0].pose.up.z == -1);       // faces the screen whatever the heading
    CHECK(organs[1].pose.heading.x == -1);  // lies in the turtle's plane
    CHECK(organs[5].surface == 'a');
    CHECK(organs[7].size == glm::dvec3(1, 2, 3));
    CHECK(organs[2].module == 7);  // the O, not the @
}

TEST_CASE("the bounds contain everything drawn, thickness included", "[turtle]") {
    Drawing drawing("!(0.2)F(2)+(90)F(1)[f@O(1)][{.f.+(90)f(5).}]f(9)");
    const Box& bounds = drawing.geometry().bounds;
    CHECK(bounds.lower.x == Approx(-2.5));
    CHECK(bounds.lower.y == Approx(-3));
    CHECK(bounds.upper.x == Approx(0.1));
    CHECK(bounds.upper.y == Approx(2.5));
    CHECK(bounds.upper.z == Approx(0.5));
    CHECK(Drawing("f+g[]").geometry().bounds.empty());
}

TEST_CASE("symbols the turtle does not draw do not disturb it", "[turtle]") {
    const Pose plain = pose_after("F+F");
    for (const char* group :
         {"@Gs",        "@Gc(3)", "@Ge(3)", "@Gt(1,1)", "@Gr(1)", "@#(1)", "@!(3)",    "@PS(1)", "@PC(1,2,3)",
          "@PD(1,2,3)", "@Tx(1)", "@Tf",    "@Tp",      "@L(1)",  "@S(1)", "@I",       "@J(1)",  "@mo",
          "@mc",        "@F",     "@+(30)", "~F",       "~+(2)",  "$",     "?(1,2)A$", "X(1)Y"}) {
        INFO(group);
        const Pose pose = pose_after(std::string("F") + group + "+F");
        CHECK(pose.position == plain.position);
        CHECK(pose.heading == plain.heading);
    }
    CHECK(Drawing("F@").geometry().internodes.size() == 1);         // nothing follows
    CHECK(Drawing("@[F]").geometry().internodes.at(0).order == 1);  // brackets are never swallowed
}

TEST_CASE("a declared name is a letter of its own, whatever stands before it", "[turtle]") {
    CHECK(Drawing("<Apex>F<Leaf>(2)F").geometry().internodes.size() == 2);
    CHECK(Drawing("@<Apex>F").geometry().internodes.size() == 1);
}

TEST_CASE("the drawing stops at a cut if the settings say so", "[turtle]") {
    Drawing drawing("F%[F]F");
    CHECK(drawing.geometry().internodes.size() == 3);
    drawing.settings.past_cut = false;
    CHECK(drawing.geometry().internodes.size() == 1);
}

TEST_CASE("interpreting twice changes nothing", "[turtle]") {
    Drawing drawing("F[+(31)F;F@o(2)?P(0,0)]{.f.+f.}!F?E(1)");
    const ModuleString before = drawing.string;
    const Interpretation first = drawing.draw();
    const Interpretation second = drawing.draw();
    CHECK(same(first, second));
    CHECK(to_text(before, drawing.model.alphabet) == to_text(drawing.string, drawing.model.alphabet));
}

TEST_CASE("a reused result holds nothing of the plant before", "[turtle]") {
    Drawing large("F[+F]F@o{.f.f.f.}?E(1)"), small("F");
    large.draw();
    interpret(small.model, *symbol_table(small.model), small.string, small.settings, nullptr, {}, large.result);
    CHECK(same(large.result, small.draw()));
}

TEST_CASE("an empty string draws nothing", "[turtle]") {
    Drawing drawing("");
    CHECK(drawing.geometry().internodes.empty());
    CHECK(drawing.geometry().bounds.empty());
}

TEST_CASE("brackets without a partner are drawn as they stand", "[turtle]") {
    Drawing drawing("F(2)]+[F]]F");
    const auto& internodes = drawing.geometry().internodes;
    REQUIRE(internodes.size() == 3);
    CHECK(internodes[2].base == internodes[0].tip);
    CHECK(internodes[2].tip == internodes[1].tip);
    CHECK(Drawing("[[F").geometry().internodes.size() == 1);
}

TEST_CASE("a turtle that is lost names the module and shows its surroundings", "[turtle]") {
    const std::string message = message_of("F(2)[+F]f(1e308)f(1e308)F");
    CHECK(message.find("module 6") != std::string::npos);
    CHECK(message.find("F(2)[+F]") != std::string::npos);
    CHECK(message.find("position") != std::string::npos);
}

TEST_CASE("a letter with more parameters acts by the first, as ABOP says", "[turtle]") {
    // ABOP 1.10.3, as its Anabaena's F(s, t, c) needs it.
    const Pose plain = pose_after("+(30)F(2)&(10)f(3)/(5)F");
    const Pose more = pose_after("+(30,7)F(2,1,900)&(10,1)f(3,0)/(5,5,5)F");
    CHECK(more.position == plain.position);
    CHECK(more.left == plain.left);
    CHECK(Drawing("!(3,1)F").geometry().internodes.at(0).tip_radius == 1.5);
    CHECK(Drawing(";(3,1)F").geometry().internodes.at(0).colour == 3);
}

TEST_CASE("the scale of a sub-L-system multiplies lengths and widths, nests, and ends at $", "[turtle]") {
    Drawing drawing("!(4)F?(2,0.5)F!(2)F?(3,0.5)F$F$F");
    const auto& internodes = drawing.geometry().internodes;
    REQUIRE(internodes.size() == 6);
    const double lengths[] = {1, 0.5, 0.5, 0.25, 0.5, 1}, widths[] = {4, 2, 1, 0.5, 1, 4};
    for (int i = 0; i < 6; ++i) {
        CHECK(glm::distance(internodes[i].base, internodes[i].tip) == Approx(lengths[i]));
        CHECK(internodes[i].tip_radius * 2 == Approx(widths[i]));
    }
    CHECK(total_length(Drawing("?(1)F$F").geometry()) == 2);
    CHECK(total_length(Drawing("[?(1,0.5)F]F").geometry()) == 1.5);  // a branch that ends without $
    CHECK_NOTHROW(Drawing("$F?(1,0.5)[F$]F$F$F").draw());            // more $ than ?
}

TEST_CASE("a scale of zero draws everything in one point", "[turtle]") {
    Drawing drawing("F@D(0)F[+F]@O(3)");
    CHECK(total_length(drawing.geometry()) == 1);
    CHECK(drawing.geometry().organs.at(0).size.x == 0);
}

TEST_CASE("lines whose width is in pixels have no radius, and queries keep the width", "[turtle]") {
    Drawing drawing("!(3)F!(2)F?E(1)");
    drawing.settings.line_style = LineStyle::pixel;
    CHECK(total_volume(drawing.geometry()) == 0);
    CHECK(drawing.geometry().bounds.upper.x == 0);
    CHECK(drawing.result.queries.at(0).width == 2);
    CHECK(drawing.result.geometry.in_pixels);
    CHECK(drawing.result.geometry.internodes[0].pixels == 3);
    drawing.settings.line_style = LineStyle::polygon;
    CHECK(total_volume(drawing.geometry()) > 0);
}

TEST_CASE("without tapered lines every segment has the width it was drawn with", "[turtle]") {
    Drawing drawing("!(4)F!(2)F");
    drawing.settings.tapered_lines = false;
    CHECK(drawing.geometry().internodes.at(1).base_radius == 1);
    CHECK(drawing.geometry().internodes.at(1).tip_radius == 1);
}

TEST_CASE("labels are texts filled in as printf does, where the turtle is", "[turtle]") {
    Drawing drawing("F@L(0,3,2.5)[+F;(7)@L(1,2)]@L(9)@L@L(0)@L(3)");
    drawing.model.texts = {"n = %d, x = %.2f", "100%% %s", "leaf", "%q"};
    const std::vector<Label>& labels = drawing.geometry().labels;
    REQUIRE(labels.size() == 4);
    CHECK(labels[0].text == "n = 3, x = 2.50");
    CHECK(labels[0].position == glm::dvec3(0, 1, 0));
    CHECK(labels[0].module == 2);
    CHECK(labels[1].text == "100% leaf");
    CHECK(labels[1].colour == 7);
    CHECK(labels[1].order == 1);
    CHECK(labels[2].text == "n = 0, x = 0.00");  // what is missing is 0
    CHECK(labels[3].text == "%q");               // what printf does not know stands as it is
    CHECK(drawing.geometry().bounds.upper.y > 1.5);
    drawing.model.texts[0] = "%9999d%9999d";
    CHECK(drawing.geometry().labels.at(0).text.size() == 1000);
}

TEST_CASE("the colour of the back goes with polygons and organs", "[turtle]") {
    Drawing plain(";(5)@O[@;@O]@O");
    CHECK(plain.geometry().organs.at(0).look.back_colour == 5);  // the front's, until it is set
    CHECK(plain.geometry().organs.at(1).look.back_colour == 129);
    CHECK(plain.geometry().organs.at(2).look.back_colour == 5);
    Drawing drawing("@;(9){.f+f.}@O@;@o");
    drawing.settings.back_colour_increment = 2;
    const PlantGeometry& geometry = drawing.geometry();
    CHECK(geometry.polygons.at(0).look.back_colour == 9);
    CHECK(geometry.organs.at(0).look.back_colour == 9);
    CHECK(geometry.organs.at(1).look.back_colour == 11);
}

TEST_CASE("numbers that are none any more are errors", "[turtle]") {
    CHECK(message_of("F(1e308)F(1e308)").find("position") != std::string::npos);
    CHECK(message_of("+(nan)F").find("position") != std::string::npos);
    CHECK(message_of("@M(0,nan)").find("position") != std::string::npos);
    CHECK(message_of("@R(0,inf)").find("heading") != std::string::npos);
    CHECK(message_of("@Dd(0)").find("scale") != std::string::npos);
    CHECK(message_of("!(nan)").find("width") != std::string::npos);
    CHECK(message_of("@o(inf)").find("organ") != std::string::npos);
    CHECK(message_of(";(nan)").find("colour") != std::string::npos);
}

TEST_CASE("@M goes to an absolute position", "[turtle]") {
    CHECK(pose_after("F@M(1,2,3)").position == glm::dvec3(1, 2, 3));
    CHECK(pose_after("F@D(7)@M(1,2)").position == glm::dvec3(1, 2, 0));
}

TEST_CASE("the walk starts at the pose of the settings", "[turtle]") {
    Drawing drawing("F");
    drawing.settings.pose.position = {5, 0, -3};
    drawing.settings.scale = 2;
    CHECK(drawing.geometry().internodes[0].tip == glm::dvec3(5, 2, -3));
}
