// Marks on a picture as axes, and what is compared of them.
#include "analysis/marked_plant.h"

#include "espalier/base/error.h"

#include "analysis/least_squares.h"
#include "analysis/line_fit.h"
#include "catch.h"
#include "temporary_folder.h"

#include <cmath>

using namespace espalier;
using namespace espalier::analysis;
using Catch::Contains;

namespace {

MarkedPlant marked(const std::string& elements, const std::string& type = "") {
    const TemporaryFolder folder;
    folder.write("marks.svg", "<?xml version=\"1.0\"?>\n" + type + "<svg xmlns=\"http://www.w3.org/2000/svg\">" +
                                  elements + "</svg>\n");
    return read_marked_plant(folder.path() / "marks.svg");
}

std::string mistake(const std::string& elements) {
    try {
        marked(elements);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

void check_nodes(const MarkedAxis& axis, const std::vector<glm::dvec2>& expected) {
    REQUIRE(axis.nodes.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(axis.nodes[i].x == Approx(expected[i].x).margin(1e-9));
        CHECK(axis.nodes[i].y == Approx(expected[i].y).margin(1e-9));
    }
}

}  // namespace

TEST_CASE("polylines, lines and straight paths are axes, upside down and moved by their groups", "[marks]") {
    const MarkedPlant plant = marked(
        "<g transform=\"translate(100, 500) scale(2)\"><polyline points=\"0,0 0,-50 10,-100\"/>"
        "<line x1=\"0\" y1=\"-50\" x2=\"30\" y2=\"-80\"/></g>"
        "<path d=\"m 100,400 -20,-20 h -5 V 300\"/>");
    REQUIRE(plant.axes.size() == 3);
    CHECK_FALSE(plant.has_scale);
    check_nodes(plant.axes[0], {{100, -500}, {100, -400}, {120, -300}});
    check_nodes(plant.axes[1], {{100, -400}, {160, -340}});
    check_nodes(plant.axes[2], {{100, -400}, {80, -380}, {75, -380}, {75, -300}});
    CHECK(plant.axes[1].parent == 0U);
    CHECK(plant.axes[1].parent_node == 1);
    CHECK(plant.axes[2].order == 1);
}

TEST_CASE("what drawing programs write besides is passed over: a document type, styles as they are, many groups",
          "[marks]") {
    std::string groups, ends;
    for (int i = 0; i < 40; ++i) {
        groups += "<g transform=\"translate(1, 0)\">";
        ends += "</g>";
    }
    const MarkedPlant plant =
        marked("<style><![CDATA[ a > b { stroke: red } ]]></style><title>roots &amp; shoots</title>" + groups +
                   "<polyline points='0,0 0,-50'/>" + ends,
               "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\">\n");
    REQUIRE(plant.axes.size() == 1);
    check_nodes(plant.axes[0], {{40, 0}, {40, 50}});
}

TEST_CASE("branches that begin at one node are siblings, however roughly they are marked", "[marks]") {
    const MarkedPlant plant = marked(
        "<polyline points=\"0,0 0,-40 0,-60\"/><polyline points=\"3,-41 30,-70\"/><polyline points=\"3,-42 "
        "-30,-70\"/>");
    CHECK(plant.axes[1].parent == 0U);
    CHECK(plant.axes[2].parent == 0U);
    CHECK(plant.axes[2].order == 1);
}

TEST_CASE("a scale gives metres", "[marks]") {
    const MarkedPlant plant =
        marked("<polyline points=\"0,0 0,-50\"/><line data-length=\"0.2\" x1=\"0\" y1=\"0\" x2=\"100\" y2=\"0\"/>");
    CHECK(plant.has_scale);
    check_nodes(plant.axes[0], {{0, 0}, {0, 0.1}});
}

TEST_CASE("lengths and angles are means by order and place along the axis", "[marks]") {
    const MarkedPlant plant = marked(
        "<polyline points=\"0,0 0,-40 0,-60\"/><polyline points=\"0,-40 10,-50 20,-60\"/>"
        "<polyline points=\"0,-40 -30,-40\"/>");
    const AxisMeasures measures = measures_of(plant, false);
    CHECK(measures.lengths.at({0, 0}) == Approx(40.0 / 60));
    CHECK(measures.lengths.at({1, 0}) == Approx((std::sqrt(200) + 30) / 2 / 60));
    CHECK(measures.lengths.at({1, 1}) == Approx(std::sqrt(200) / 60));
    CHECK(measures.angles.at({1, 1}) == Approx((45 + 90) / 2.0));
}

TEST_CASE("marks that are none are refused with what to draw", "[marks]") {
    CHECK_THAT(mistake("<circle r=\"3\"/>"), Contains("has no axis") && Contains("polyline"));
    CHECK_THAT(mistake("<path d=\"M 0,0 C 1,1 2,2 3,3\"/>"), Contains("a path has 'C'") && Contains("straight"));
    CHECK_THAT(mistake("<polyline points=\"0,0 1\"/>"), Contains("expected a number"));
    CHECK_THAT(mistake("<g transform=\"skewX(3)\"><polyline points=\"0,0 1,1\"/></g>"),
               Contains("'skewX' is not read"));
    CHECK_THAT(mistake("<line data-length=\"0\" x1=\"0\" y1=\"0\" x2=\"1\" y2=\"0\"/>"), Contains("data-length"));
    CHECK_THAT(mistake("<polyline points=\"0,0 1,1\""), Contains("no SVG that can be read"));
    CHECK_THROWS_WITH(read_marked_plant("marks.png"), Contains("holds no marks"));
}

TEST_CASE("least squares find a straight line and its error, and stay within bounds", "[marks]") {
    const std::vector<double> x{0, 1, 2, 3, 4}, y{1.1, 2.9, 5.2, 6.8, 9.1};
    const Residuals line = [&](const std::vector<double>& p) {
        std::vector<double> rest;
        for (std::size_t i = 0; i < x.size(); ++i) rest.push_back(p[0] + p[1] * x[i] - y[i]);
        return rest;
    };
    const LineFit exact = fit_line(x, y);
    const LeastSquares fit = fit_least_squares({{0}, {1}}, line);
    CHECK(fit.values[0] == Approx(exact.intercept).epsilon(1e-6));
    CHECK(fit.values[1] == Approx(exact.slope).epsilon(1e-6));
    CHECK(fit.errors[1] == Approx(exact.error).epsilon(1e-4));
    CHECK(fit_least_squares({{0}, {1, 0, 1.5}}, line).values[1] == Approx(1.5));
    CHECK(std::isnan(fit_least_squares({{0}, {1}, {3}}, line).errors[2]));
    CHECK_THROWS_WITH(fit_least_squares(std::vector<FreeParameter>(6), line), Contains("5 measures cannot decide 6"));
}
