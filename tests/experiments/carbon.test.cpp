// Growth that light has paid for: what a neighbour costs, and what a field yields.
#include "catch.h"
#include "experiments/growth.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace espalier;

namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

double statistic(const World& world, const char* name, std::uint32_t plant) {
    return world.environment().statistic(name, plant);
}

/// The carbon of each plant after some days; the balance holds in each step.
std::vector<double> carbon_after(const char* scene, int days, const Overrides& overrides = {}) {
    SceneOptions options;
    options.steps = days;
    options.overrides = overrides;
    World world(read_scene(source_path(scene), options));
    world.start();
    while (!world.at_end()) {
        world.step();
        for (std::uint32_t plant = 0; plant < world.size(); ++plant) {
            REQUIRE(std::abs(statistic(world, "carbon.balance", plant)) < 1e-12);
        }
    }
    std::vector<double> carbon;
    for (std::uint32_t plant = 0; plant < world.size(); ++plant) {
        carbon.push_back(statistic(world, "carbon.structure", plant) + statistic(world, "carbon.reserve", plant));
    }
    return carbon;
}

double sum(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

/// Of nine plants on a grid, g per m2.
double yield(double spacing, int days, const std::string& seed) {
    const double half = 1.5 * spacing;
    const std::string x = std::to_string(half);
    const Overrides field{
        {"plant.0.grid.spacing", std::to_string(spacing)},
        {"simulation.seed", seed},
        {"simulation.domain", "{ lower = [-" + x + ", 0, -" + x + "], upper = [" + x + ", 3, " + x + "] }"}};
    return sum(carbon_after("environments/yield-by-density.toml", days, field)) / (9 * spacing * spacing);
}

}  // namespace

TEST_CASE("a neighbour takes a fifth to a half of what a tree would have built", "[carbon]") {
    for (const char* seed : {"4", "11"}) {
        const Overrides seeded{{"simulation.seed", seed}};
        const double alone = carbon_after("environments/price-of-shade-alone.toml", 45, seeded).at(0);
        const std::vector<double> both = carbon_after("environments/price-of-shade.toml", 45, seeded);
        CHECK(both[0] < 0.8 * alone);
        CHECK(both[0] > 0.5 * alone);
        CHECK(std::abs(both[0] - both[1]) < 0.1 * both[0]);
    }
}

TEST_CASE("trees out of each other's light pay nothing for each other", "[carbon]") {
    const double alone = carbon_after("environments/price-of-shade-alone.toml", 30).at(0);
    const std::vector<double> apart =
        carbon_after("environments/price-of-shade.toml", 30, {{"plant.1.position", "[12, 0, 0]"}});
    CHECK(apart[0] == Approx(alone).epsilon(0.03));  // their voxels lie differently
}

TEST_CASE("a field's final yield depends little on its density", "[carbon]") {
    // Nine times as many plants begin with about nine times the yield.
    CHECK(yield(0.2, 10, "5") / yield(0.6, 10, "5") > 6);
    const double ratio = yield(0.2, 60, "5") / yield(0.6, 60, "5");
    CHECK(ratio > 1);
    CHECK(ratio < 1.4);
}

namespace {

/// The masses of a shoot's fruits from the base up, then the root's.
std::vector<double> fruits(const Overrides& overrides) {
    SceneOptions options;
    options.overrides = overrides;
    World world(read_scene(source_path("environments/fruiting-shoot.toml"), options));
    world.start();
    while (!world.at_end()) world.step();
    const ModuleString& string = world.string(0);
    const Alphabet& alphabet = world.model(0).alphabet;
    const std::vector<std::size_t> offsets = parameter_offsets(string, alphabet);
    std::vector<double> masses;
    double root = 0;
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (alphabet.name(string.letters[i]) == "K") masses.push_back(string.parameters[offsets[i]]);
        if (alphabet.name(string.letters[i]) == "R") root = string.parameters[offsets[i]];
    }
    masses.push_back(root);
    return masses;
}

}  // namespace

TEST_CASE("thinned fruits leave larger ones, and a girdle keeps carbon above it", "[carbon]") {
    for (const char* gain : {"0.08", "0.05"}) {
        const std::pair<std::string, std::string> leaf{"plant.0.define.GAIN", gain};
        const std::vector<double> all = fruits({leaf});
        const std::vector<double> thinned = fruits({leaf, {"plant.0.define.THINNED", "2"}});
        const std::vector<double> girdled = fruits({leaf, {"plant.0.define.GIRDLE", "1"}});
        REQUIRE(all.size() == 7);
        REQUIRE(thinned.size() == 4);
        CHECK(thinned[1] > 1.3 * all[3]);
        CHECK(girdled[4] > 1.2 * all[4]);
        CHECK(girdled.back() < 0.5 * all.back());
    }
}
