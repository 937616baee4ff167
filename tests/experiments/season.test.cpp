// A cereal from sowing to harvest under a weather file: development by thermal time, growth by gain, water by roots.
#include "catch.h"
#include "experiments/growth.h"

#include <cmath>

using namespace espalier;

namespace {

struct Harvest {
    std::vector<double> thermal, leaves;  ///< by day; of the plant with most leaves
    double structure = 0, ear = 0;        ///< means of the plants, g of carbon
    double given = 0, taken = 0, drunk = 0, lowest = 0, gain = 0, big_gain = 0;
    double carbon_balance = 0, water_balance = 0, soil_balance = 0, residual = 0;
};

/// Modules of a plant with this symbol, and the sum of their first parameters.
double count_of(const World& world, std::size_t plant, const std::string& symbol, double* mass = nullptr) {
    const ModuleString& string = world.string(plant);
    const Alphabet& alphabet = world.model(plant).alphabet;
    const std::vector<std::size_t> begins = parameter_offsets(string, alphabet);
    double count = 0;
    for (std::size_t m = 0; m < string.size(); ++m) {
        if (alphabet.name(string.letters[m]) != symbol) continue;
        ++count;
        if (mass) *mass += string.parameters[begins[m]];
    }
    return count;
}

Harvest grown(const std::vector<std::pair<std::string, std::string>>& overrides, double ground) {
    SceneOptions options;
    options.seed = 7;
    options.overrides = overrides;
    World world(read_scene(source_path("environments/season.toml"), options));
    world.start();
    Harvest harvest;
    while (!world.at_end()) {
        world.step();
        const auto of = [&](const char* name, std::uint32_t plant = 0) {
            return world.environment().statistic(name, plant);
        };
        harvest.thermal.push_back(of("air.thermal_sum"));
        harvest.leaves.push_back(0);
        harvest.taken = 0;
        for (std::uint32_t plant = 0; plant < 4; ++plant) {
            harvest.leaves.back() = std::max(harvest.leaves.back(), count_of(world, plant, "L"));
            harvest.given += of("leaves.water", plant);
            harvest.taken += of("roots.total", plant);
            const double potential = of("leaves.potential", plant);
            if (std::isfinite(potential)) harvest.lowest = std::min(harvest.lowest, potential);
            harvest.gain += of("leaves.gain", plant);
            if (of("leaves.leaf_area", plant) > 0) harvest.big_gain += of("leaves.big_gain", plant);
            harvest.residual = std::max(harvest.residual, of("leaves.residual", plant));
            harvest.carbon_balance = std::max(harvest.carbon_balance, std::abs(of("carbon.balance", plant)));
            harvest.water_balance = std::max(harvest.water_balance, std::abs(of("roots.water_balance", plant)));
        }
        harvest.drunk = 0.1 * ground * of("water.drunk");
        harvest.soil_balance = std::max(harvest.soil_balance, std::abs(of("water.balance")));
    }
    for (std::uint32_t plant = 0; plant < 4; ++plant) {
        harvest.structure += world.environment().statistic("carbon.structure", plant) / 4;
        count_of(world, plant, "E", &harvest.ear);
    }
    harvest.ear /= 4;
    return harvest;
}

const Harvest& usual() {
    static const Harvest harvest = grown({}, 196);
    return harvest;
}

}  // namespace

TEST_CASE("a cereal emerges and makes its leaves by thermal time", "[season]") {
    const Harvest& harvest = usual();
    for (std::size_t day = 0; day < harvest.thermal.size(); ++day) {
        INFO("day " << day << ": " << harvest.thermal[day] << " K d, " << harvest.leaves[day] << " leaves");
        const double due = (harvest.thermal[day] - 110) / 75 + 1;
        if (harvest.thermal[day] > 700) break;
        CHECK(harvest.leaves[day] <= std::max(0.0, std::floor(due)));
        if (harvest.thermal[day] > 660) CHECK(harvest.leaves[day] >= 6);
    }
}

TEST_CASE("what a field gains, drinks and holds is balanced from sowing to harvest", "[season]") {
    const Harvest& harvest = usual();
    INFO("structure " << harvest.structure << ", ear " << harvest.ear << ", water " << harvest.given
                      << " cm3, one big leaf " << harvest.big_gain / harvest.gain);
    CHECK(harvest.given == Approx(harvest.taken).epsilon(1e-9));
    CHECK(harvest.drunk == Approx(harvest.taken).epsilon(1e-9));
    CHECK(harvest.carbon_balance < 1e-9);
    CHECK(harvest.water_balance < 1e-9);
    CHECK(harvest.soil_balance < 1e-9);
    CHECK(harvest.residual < 1e-8);
    CHECK(harvest.ear > 0.3 * harvest.structure);
    CHECK(harvest.ear < 0.9 * harvest.structure);
    // A canopy is no big leaf: the mean of the light makes more of it.
    CHECK(harvest.big_gain > 1.05 * harvest.gain);
}

TEST_CASE("more carbon dioxide saves water, half the rain costs growth, a dense field has smaller plants", "[season]") {
    const Harvest& field = usual();
    const Harvest rich = grown({{"environment.air.co2", "800"}}, 196);
    const Harvest dry = grown({{"environment.air.rain_factor", "0.5"}}, 196);
    const Harvest dense =
        grown({{"plant.0.grid.spacing", "0.05"},
               {"simulation.domain", "{ lower = [-0.05, 0, -0.05], upper = [0.05, 1.05, 0.05] }"},
               {"environment.water.domain", "{ lower = [-0.05, -1.05, -0.05], upper = [0.05, 0, 0.05] }"},
               {"environment.water.voxel", "0.05"},
               {"environment.light.voxel", "0.05"}},
              100);
    INFO("carbon of a plant " << field.structure << ", rich " << rich.structure << ", dry " << dry.structure
                              << ", dense " << dense.structure << "; ears " << field.ear << ", " << rich.ear << ", "
                              << dry.ear << ", " << dense.ear << "; water " << field.given << ", " << rich.given << ", "
                              << dry.given << ", " << dense.given << "; lowest " << field.lowest << ", " << rich.lowest
                              << ", " << dry.lowest << ", " << dense.lowest);
    CHECK(rich.structure > 1.05 * field.structure);
    CHECK(rich.structure < 1.6 * field.structure);
    CHECK(rich.given < 0.9 * field.given);
    CHECK(dry.structure < 0.95 * field.structure);
    CHECK(dry.given < 0.85 * field.given);
    CHECK(dry.lowest < field.lowest - 0.3);
    CHECK(dense.structure < 0.6 * field.structure);
    const double yields = dense.structure / 25 / (field.structure / 49);  // 5 and 7 cm from plant to plant
    CHECK(yields > 0.75);
    CHECK(yields < 1.25);
    for (const Harvest* harvest : {&rich, &dry, &dense}) {
        CHECK(harvest->drunk == Approx(harvest->taken).epsilon(1e-9));
        CHECK(harvest->carbon_balance < 1e-9);
        CHECK(harvest->residual < 1e-8);
    }
}
