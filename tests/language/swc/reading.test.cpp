// Trees of points: axes, units, and what is no such file.
#include "catch.h"
#include "language/measured_file.h"

using namespace espalier;

namespace {

const MeasuredText swc_file{"swc", "root.swc"};

/// A stem of 3 cm, from whose second point a branch of 1.5 cm runs.
const std::string points_of_root =
    "# unit: cm\n# up: z\n1 2 0 0 0 0.1 -1\n2 2 0 0 -1 0.1 1\n3 2 0 1.5 -1 0.05 2\n4 2 0 0 -2 0.1 2\n5 2 0 0 -3 0.1 "
    "4\n";

}  // namespace

TEST_CASE("SWC: an axis goes on to its farthest tip", "[swc]") {
    const MeasuredPlants plants = swc_file.read(points_of_root);
    REQUIRE(plants.axes.size() == 2);
    CHECK(plants.axes[0].nodes.size() == 4);
    CHECK(plants.axes[0].nodes[3].at.y == Approx(-0.03));
    CHECK(plants.axes[1].order == 1);
    CHECK(plants.axes[1].on_node == 1);
    CHECK(plants.axes[1].nodes.back().diameter == Approx(0.001));
    CHECK(summary_of(plants).length == Approx(0.045));
    CHECK(summary_of(plants).link_length == 0);
}

TEST_CASE("SWC: points may stand in any order, and a point without parent begins a plant", "[swc]") {
    const MeasuredPlants plants = swc_file.read("7 0 0 0 1 1 3\n3 0 0 0 0 1 -1\n4 0 5 0 0 1 -1\n5 0 5 0 2 1 4\n");
    CHECK(plants.plants.size() == 2);
    CHECK(summary_of(plants).length == Approx(3e-6));
}

TEST_CASE("SWC: what was guessed is told", "[swc]") {
    const std::string bare = points_of_root.substr(points_of_root.find("1 2"));
    CHECK_THAT(swc_file.warnings(bare), Catch::Contains("micrometres, those of neurons, are taken") &&
                                            Catch::Contains("z is taken") &&
                                            Catch::Contains("column 'type' is not used"));
    MeasuredOptions options;
    options.unit = "mm";
    options.up = "-z";
    CHECK(swc_file.summary(bare, options).extent[1].y == Approx(0.003));
    CHECK(swc_file.warnings(bare, options) == "column 'type' is not used (5 places)\n");
}

TEST_CASE("SWC: malformed files end in one line", "[swc]") {
    CHECK(swc_file.mistake("") == "root.swc:1:1: this file has no points");
    CHECK_THAT(swc_file.mistake("1 2 0 0 0 1\n"),
               Catch::Contains("root.swc:1:7: ") && Catch::Contains("parent is missing"));
    CHECK_THAT(swc_file.mistake("1 2 0 0 up 1 -1\n"),
               Catch::Contains("root.swc:1:5: ") && Catch::Contains("z is 'up'"));
    CHECK_THAT(swc_file.mistake("1 2 0 0 0 1 -1\n2 2 0 0 1 1 9\n"),
               Catch::Contains("root.swc:2:1: there is no number 9"));
    CHECK_THAT(swc_file.mistake("1 2 0 0 0 1 2\n2 2 0 0 1 1 1\n"), Catch::Contains("lead round in a ring"));
    CHECK_THAT(swc_file.mistake("# unit: miles\n1 2 0 0 0 1 -1\n"), Catch::Contains("the unit 'miles'"));
}
