// A clear day of a plant whose leaves and roots exchange water with air and soil.
#include "catch.h"
#include "experiments/growth.h"

using namespace espalier;

namespace {

/// Sums of a day, and the efficiency of each step.
struct LeafDay {
    double gain = 0, leaf_water = 0, root_water = 0, soil_water = 0, residual = 0;
    std::vector<double> efficiency;
};

LeafDay grown(const std::vector<std::pair<std::string, std::string>>& overrides = {}) {
    SceneOptions options;
    options.overrides = overrides;
    World world(read_scene(source_path("environments/leaf-day.toml"), options));
    world.start();
    LeafDay day;
    while (!world.at_end()) {
        world.step();
        const auto value = [&](const char* name) { return world.environment().statistic(name, 0); };
        day.gain += value("leaves.gain");
        day.leaf_water += value("leaves.water");
        day.soil_water = 40 * value("water.drunk");  // mm since the beginning, over 400 cm2
        day.root_water = value("roots.total");
        day.residual = std::max(day.residual, value("leaves.residual"));
        day.efficiency.push_back(value("leaves.efficiency"));
    }
    return day;
}

}  // namespace

TEST_CASE("what leaves give is what roots take is what the soil loses", "[leaf-day]") {
    for (const char* plant : {"12", "5"}) {
        const LeafDay day = grown({{"plant.0.define.LEAVES", plant}});
        CHECK(day.leaf_water > 10);
        CHECK(day.root_water == Approx(day.leaf_water).epsilon(1e-9));
        CHECK(day.soil_water == Approx(day.leaf_water).epsilon(1e-9));
        CHECK(day.residual < 1e-10);
    }
}

TEST_CASE("a mol of water buys less carbon in the warm afternoon than after sunrise", "[leaf-day]") {
    const LeafDay day = grown();
    CHECK(day.gain > 0);
    CHECK(day.efficiency[12] > 2 * day.efficiency[28]);  // after steps 13 and 29: 6:30 and 14:30
}

TEST_CASE("dry leaves save water at the price of carbon, and use it better", "[leaf-day]") {
    const LeafDay wet = grown(), dry = grown({{"environment.leaves.potential", "-1"}});
    CHECK(dry.leaf_water < 0.8 * wet.leaf_water);
    CHECK(dry.gain < wet.gain);
    CHECK(dry.gain / dry.leaf_water > wet.gain / wet.leaf_water);
}
