// models/brackets: counts of letters as printed, widths and colours along paths, areas.
#include "catch.h"
#include "experiments/growth.h"
#include "models/paths.h"

#include <cmath>
#include <map>
#include <vector>

using namespace espalier;

namespace {

LonePlant grown_plant(const std::string& file, int steps, Defines defines = {}) {
    LonePlant plant("models/brackets/" + file + ".l", std::move(defines));
    plant.grow(steps);
    return plant;
}

/// How many modules of a name stand between the root and each module, brackets obeyed.
std::vector<int> on_the_path(const LonePlant& plant, const std::string& name) {
    std::vector<int> counts, stack;
    int count = 0;
    for (LetterId letter : plant.string.letters) {
        if (letter == Alphabet::open_bracket) stack.push_back(count);
        if (letter == Alphabet::close_bracket) {
            count = stack.back();
            stack.pop_back();
        }
        counts.push_back(count);
        if (plant.model->alphabet.name(letter) == name) ++count;
    }
    return counts;
}

}  // namespace

TEST_CASE("First branches: 8 segments, 4 branches of the first order and 1 of the second; ] restores to the bit",
          "[brackets]") {
    const LonePlant plant = grown_plant("first-branches", 0);
    const PlantGeometry& geometry = plant.interpretation.geometry;
    REQUIRE(geometry.internodes.size() == 8);
    std::map<int, int> axes_of_order;
    std::map<std::uint32_t, int> order_of_axis;
    for (const Internode& internode : geometry.internodes) order_of_axis[internode.axis] = internode.order;
    for (const auto& [axis, order] : order_of_axis) ++axes_of_order[order];
    CHECK(axes_of_order == std::map<int, int>{{0, 1}, {1, 4}, {2, 1}});
    // F[+F][-F[-F]F]F[+F][-F]: the bases of all branches are tips of the segment before their bracket.
    const auto& all = geometry.internodes;
    CHECK(all[1].base == all[0].tip);
    CHECK(all[2].base == all[0].tip);
    CHECK(all[3].base == all[2].tip);
    CHECK(all[4].base == all[2].tip);
    CHECK(all[5].base == all[0].tip);
    CHECK(all[5].tip == glm::dvec3(0, 2, 0));
    CHECK(all[6].base == all[5].tip);
    CHECK(all[7].base == all[5].tip);
}

TEST_CASE("Plants a to f have the segments, branches and letters that are printed for them", "[brackets]") {
    struct Published {
        const char* file;
        int steps, segments, branches, letters;
    };
    for (const Published& plant :
         {Published{"plant-a", 5, 3125, 1562, 7811}, Published{"plant-b", 5, 3125, 2343, 9373},
          Published{"plant-c", 4, 4096, 1170, 11116}, Published{"plant-c-bent", 4, 4096, 1170, 9361},
          Published{"plant-d", 7, 4118, 2186, 13956}, Published{"plant-e", 7, 4118, 2186, 12863},
          Published{"plant-f", 5, 1488, 1023, 6263}}) {
        INFO(plant.file);
        const LonePlant grown = grown_plant(plant.file, plant.steps);
        CHECK(grown.counts()["F"] == plant.segments);
        CHECK(grown.counts()["["] == plant.branches);
        CHECK(grown.counts()["]"] == plant.branches);
        CHECK(grown.string.size() == static_cast<std::size_t>(plant.letters));
        CHECK(grown.interpretation.geometry.internodes.size() == static_cast<std::size_t>(plant.segments));
    }
}

TEST_CASE("Bush: the printed numbers of apices, segments, leaves and letters, in both printed versions", "[brackets]") {
    struct Published {
        int steps, segments, leaf_buds, leaves;
        std::size_t letters;
        Defines defines;
    };
    for (const Published& bush :
         {Published{5, 420, 285, 135, 8294, {}}, Published{5, 420, 285, 135, 9354, {{"EIGHT", "1"}}},
          Published{7, 3891, 2607, 1284, 77399, {}}}) {
        const LonePlant grown = grown_plant("bush", bush.steps, bush.defines);
        CHECK(grown.counts()["A"] == std::lround(std::pow(3, bush.steps)));
        CHECK(grown.counts()["F"] == bush.segments);
        CHECK(grown.counts()["L"] == bush.leaf_buds);
        CHECK(grown.string.size() == bush.letters);
        const PlantGeometry& geometry = grown.interpretation.geometry;
        REQUIRE(geometry.polygons.size() == static_cast<std::size_t>(bush.leaves));
        for (const Polygon& leaf : geometry.polygons) CHECK(leaf.count == 6);
    }
}

TEST_CASE("Bush: a segment's colour counts the ' on the path to it", "[brackets]") {
    const LonePlant bush = grown_plant("bush", 5);
    const std::vector<int> ticks = on_the_path(bush, "'");
    int most = 0;
    for (const Internode& internode : bush.interpretation.geometry.internodes) {
        CHECK(internode.colour == 128 + ticks[internode.module]);
        most = std::max(most, ticks[internode.module]);
    }
    CHECK(most > 1);
}

TEST_CASE("Finished bush: turtle symbols only are left, and no segment is lost", "[brackets]") {
    const std::string nonterminals = "ASL";
    LonePlant bush("models/brackets/bush-finished.l"), unfinished("models/brackets/bush.l");
    bush.derivation.set_length(6);
    bush.grow(5);
    unfinished.grow(5);
    CHECK(bush.text() == unfinished.text());
    bush.grow(1);
    unfinished.grow(1);
    for (char symbol : nonterminals) CHECK(bush.counts()[std::string(1, symbol)] == 0);
    CHECK(bush.counts()["F"] == unfinished.counts()["F"]);
    CHECK(bush.counts()["{"] == unfinished.counts()["{"] + unfinished.counts()["L"]);
}

TEST_CASE("Widths and colours: after k forks w q^k and k colours on", "[brackets]") {
    const LonePlant tree = grown_plant("widths-and-colours", 8);
    const std::vector<int> forks = on_the_path(tree, ";");
    const PlantGeometry& geometry = tree.interpretation.geometry;
    REQUIRE(geometry.internodes.size() == 255);
    for (const Internode& internode : geometry.internodes) {
        const int k = forks[internode.module];
        CHECK(internode.tip_radius == Approx(0.4 * std::pow(0.707, k) / 2));
        CHECK(internode.colour == 1 + k);
        CHECK(internode.order == k);
    }
}

TEST_CASE("Flowering plant: modules follow their recurrence; five petals and stamens to a flower", "[brackets]") {
    LonePlant plant("models/brackets/flowering-plant.l");
    long plants = 1, internodes = 0, segments = 0, leaves = 0, flowers = 0, pedicels = 0, wedges = 0;
    long stalks = 0, blades = 0, petals = 0;
    for (int step = 1; step <= 7; ++step) {
        stalks += 2 * internodes + segments + 2 * pedicels + wedges;
        blades += leaves;
        petals += wedges;
        const long new_segments = 2 * internodes + 2 * segments, new_leaves = 2 * plants + 2 * internodes;
        wedges = 5 * flowers;
        pedicels = flowers;
        flowers = 3 * plants;
        internodes = 2 * plants;
        plants = 3 * plants;
        segments = new_segments;
        leaves = new_leaves;
        plant.grow(1);
        auto counts = plant.counts();
        CHECK(counts["Plant"] == plants);
        CHECK(counts["Internode"] == internodes);
        CHECK(counts["Segment"] == segments);
        CHECK(counts["Leaf"] == leaves);
        CHECK(counts["Flower"] == flowers);
        CHECK(counts["Pedicel"] == pedicels);
        CHECK(counts["Wedge"] == wedges);
        CHECK(counts["F"] == stalks);
        CHECK(plant.interpretation.geometry.polygons.size() == static_cast<std::size_t>(blades + petals));
    }
}

TEST_CASE("Pythagoras' tree: every generation of squares covers as much as the first, whatever the angle",
          "[brackets]") {
    for (const char* angle : {"30", "36", "45", "70"}) {
        const LonePlant tree = grown_plant("pythagoras", 8, {{"ANGLE", angle}});
        const PlantGeometry& geometry = tree.interpretation.geometry;
        REQUIRE(geometry.polygons.size() == 255);
        std::map<int, double> area;
        std::map<int, int> squares;
        for (const Polygon& square : geometry.polygons) {
            REQUIRE(square.count == 4);
            const auto first = geometry.vertices.begin() + square.first;
            area[square.order] += enclosed_area({first, first + 4});
            ++squares[square.order];
        }
        CHECK(area.size() == 8);
        for (const auto& [generation, sum] : area) CHECK(sum == Approx(1));
        for (const auto& [generation, count] : squares) CHECK(count == 1 << (generation - 1));
    }
}

TEST_CASE("A tree that grows everywhere: a segment's length tells its age", "[brackets]") {
    const LonePlant tree = grown_plant("growing-tree", 10);
    CHECK(tree.counts()["A"] == 1024);
    std::map<int, int> of_order;
    for (const Internode& internode : tree.interpretation.geometry.internodes) {
        CHECK(glm::length(internode.tip - internode.base) == Approx(std::pow(1.456, 9 - internode.order)));
        ++of_order[internode.order];
    }
    for (const auto& [order, count] : of_order) CHECK(count == 1 << order);
}
