// Root systems in Dune's grid format: units, directions, axes, and what is no such file.
#include "language/measured_file.h"

#include <espalier/base/error.h>

using namespace espalier;
using Catch::Contains;

namespace {

const MeasuredText dgf_file{"dgf", "root.dgf"};

std::string dgf_text(const std::string& vertices, const std::string& parameters, const std::string& segments) {
    return "DGF\nVertex\n" + vertices + "#\nSIMPLEX\n" + parameters + segments + "#\nBOUNDARYDOMAIN\ndefault 1\n#\n";
}

// A tap root of 20 cm with a lateral of 5 cm at 10 cm, in m.
const std::string in_metres = "0 0 0\n0 0 -0.1\n0 0 -0.2\n0.05 0 -0.1\n";
const std::string names = "parameters 5 # order, brID, surf [cm2], radius [cm], emergence time [d]\n";
// 2 pi 0.1 cm 10 cm = 6.2832 cm2
const std::string rows = "0 1 0 1 6.283185307 0.1 1\n1 2 0 1 6.283185307 0.1 2\n1 3 1 2 0.314159265 0.01 3\n";

std::string dgf_mistake(const std::string& text) {
    try {
        dgf_file.read(text);
    } catch (const UserError& error) {
        return to_string(error.diagnostics()[0].place) + ": " + error.diagnostics()[0].message;
    }
    return "";
}

}  // namespace

TEST_CASE("DGF: segments become axes by their branches, with radii and days", "[dgf]") {
    const auto plants = dgf_file.read(dgf_text(in_metres, names, rows));
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    REQUIRE(plants.axes[0].nodes.size() == 3);
    CHECK(plants.axes[0].order == 0);
    CHECK(plants.axes[0].nodes[1].diameter == Approx(0.002));
    CHECK(plants.axes[0].nodes[2].day == 2);
    CHECK(plants.axes[1].order == 1);
    CHECK(plants.axes[1].on_node == 1);
    CHECK(plants.axes[1].nodes[1].diameter == Approx(0.0002));
    CHECK(plants.unit == "m");
    CHECK(plants.up == "z");
    CHECK_THAT(warnings_of(plants), Contains("block BOUNDARYDOMAIN is not used"));
}

TEST_CASE("DGF: the unit of coordinates is told by surface = 2 pi radius length, or given", "[dgf]") {
    const std::string in_cm = "0 0 0\n0 0 -10\n0 0 -20\n5 0 -10\n";
    const auto plants = dgf_file.read(dgf_text(in_cm, names, rows));
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK(plants.unit == "cm");
    CHECK(plants.axes[0].nodes[1].diameter == Approx(0.002));
    CHECK_THAT(warnings_of(plants), Contains("coordinates are taken as cm"));
    // Lengths of segments tell it, too; without anything, metres are guessed.
    check_measures(dgf_file.read(dgf_text(in_cm, "parameters 1: length\n", "0 1 10\n1 2 10\n1 3 5\n")),
                   {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK_THAT(warnings_of(dgf_file.read(dgf_text(in_cm, "", "0 1\n1 2\n1 3\n"))), Contains("taken as m"));
    check_measures(dgf_file.read(dgf_text(in_cm, "", "0 1\n1 2\n1 3\n"), {.unit = "mm"}),
                   {1, 2, 0.025, {0.005, 0.020, 0}});
}

TEST_CASE("DGF: children may stand before their parents, and in front of them in a row", "[dgf]") {
    const std::string reversed = "3 1 1 2 0.314159265 0.01 3\n2 1 0 1 6.283185307 0.1 2\n1 0 0 1 6.283185307 0.1 1\n";
    const auto plants = dgf_file.read(dgf_text(in_metres, names, reversed));
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    REQUIRE(plants.axes[0].nodes.size() == 3);
    CHECK(plants.axes[0].nodes[0].at.y == 0);
    CHECK(plants.axes[1].on_node == 1);
    CHECK_THAT(warnings_of(plants), Contains("from the child to the parent"));
    CHECK_THAT(warnings_of(dgf_file.read(dgf_text(in_metres, names,
                                                  "1 3 1 2 0.3 0.01 3\n1 2 0 1 6.2 0.1 2\n"
                                                  "0 1 0 1 6.2 0.1 1\n"))),
               !Contains("child"));
}

TEST_CASE("DGF: the dummy segment of the shoot does not count", "[dgf]") {
    const std::string vertices = "0 0 0.03\n" + in_metres;
    const auto plants =
        dgf_file.read(dgf_text(vertices,
                               "parameters 7 # order branch surf[cm2] radius [cm] kz[cm4 hPa-1 d-1] "
                               "emergence[d] organType\n",
                               "0 1 -1 0 0 0.1 5 0 3\n1 2 0 1 6.283185307 0.1 5 1 2\n2 3 0 1 6.283185307 0.1 5 2 2\n"
                               "2 4 1 2 0.314159265 0.01 5 3 2\n"));
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK(plants.axes[0].nodes[2].day == 2);
    CHECK_THAT(warnings_of(plants), Contains("a segment of order -1 is no root and is left out"));
    CHECK_THAT(warnings_of(plants), Contains("column 'kz' is not used"));
}

TEST_CASE("DGF: names may count the vertices, or lack", "[dgf]") {
    const auto named = dgf_file.read(
        dgf_text(in_metres, "parameters 5 # node1ID, node2ID, order, branch, surf, radius, emergence\n", rows));
    check_measures(named, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK(named.axes[0].nodes[1].diameter == Approx(0.002));
    const auto by_order = dgf_file.read(
        dgf_text(in_metres, "parameters 5\n", "0 1 0 1 6.283 10 0.1\n1 2 0 1 6.283 10 0.1\n1 3 1 2 0.314 5 0.01\n"));
    check_measures(by_order, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK(by_order.axes[0].nodes[1].diameter == Approx(0.002));
    CHECK_THAT(warnings_of(by_order), Contains("5 columns have 0 names"));
}

TEST_CASE("DGF: without branches an axis goes on with its order, or with the thickest segment", "[dgf]") {
    const auto by_order =
        dgf_file.read(dgf_text(in_metres, "parameters 2: order length\n", "1 3 1 5\n1 2 0 10\n0 1 0 10\n"));
    REQUIRE(by_order.axes.size() == 2);
    CHECK(by_order.axes[0].nodes.size() == 3);
    const auto by_radius =
        dgf_file.read(dgf_text(in_metres, "parameters 2: radius length\n", "1 3 0.01 5\n1 2 0.1 10\n0 1 0.1 10\n"));
    REQUIRE(by_radius.axes.size() == 2);
    CHECK(by_radius.axes[0].nodes.size() == 3);
}

TEST_CASE("DGF: emergence in seconds, or said to be", "[dgf]") {
    const auto last = [&](const std::string& values) {
        return dgf_file.read(dgf_text(in_metres, "parameters 2: length, emergence time [s]\n",
                                      "0 1 10 " + values + "\n1 2 10 " + values + "\n1 3 5 " + values + "\n"));
    };
    CHECK(last("864000").axes[0].nodes[1].day == Approx(10));
    CHECK(last("10").axes[0].nodes[1].day == 10);
    CHECK_THAT(warnings_of(last("10")), Contains("taken as days"));
}

TEST_CASE("DGF: what is no such file is refused at its line", "[dgf]") {
    CHECK_THAT(dgf_mistake(""), Contains("first word is not DGF"));
    CHECK_THAT(dgf_mistake("<dgf/>\n"), Contains("root.dgf:1:1: this is no file"));
    CHECK_THAT(dgf_mistake("DGF\nVertex\n0 0 0\n#\n"), Contains("no block Simplex"));
    CHECK_THAT(dgf_mistake("DGF\nVertex\n0 0\n"), Contains("root.dgf:3:4: a number"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "", "0 4\n")), Contains("there is no vertex 4: there are 4, from 0"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "", "0 1\n1 0\n")), Contains("belongs to a loop"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "", "0 1\n2 1\n0 3\n")), Contains("two segments"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "parameters 1\n", "0 1\n")), Contains("a number, one for each"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "", "0 1 7\n")), Contains("this row is longer"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "parameters 1000000000\n", "0 1\n")), Contains("their number"));
    CHECK_THAT(dgf_mistake(dgf_text(in_metres, "parameters 1000000\n", "0 1\n")), Contains("a number, one for each"));
}
