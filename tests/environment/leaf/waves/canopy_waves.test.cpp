// Long waves among sky, leaves and soil against closed forms, and their balance.
#include "environment/leaf/waves/canopy_waves.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"

#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;
using leaf::black_body;

namespace {

EnvironmentContext context_of(std::uint32_t plants) {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = plants;
    return context;
}

const std::string noon =
    "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { par = 1100, diffuse = 0.3, sun = [1, "
    "2, 0] }\n";
const std::string night = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { latitude = 80, day = 355 }\n";
const std::string breathing = "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\ntemperature = 18\n";

AskingPlants plant_of(std::size_t modules, std::uint32_t plants = 1) {
    AskingPlants all;
    for (std::uint32_t plant = 0; plant < plants; ++plant) {
        all.add(std::vector<Asked>(modules, Asked{{0, 0, 0}, {0}}));
    }
    return all;
}

double of_world(const Environment& environment, const std::string& quantity) {
    return environment.statistic("leaves." + quantity, 0);
}

/// Level leaves of 1 dm2 in the layer of voxels that begins at `floor`: an area index over the domain's 4 m2.
void draw_layer(PlantGeometry& geometry, std::uint32_t module, double floor, double area_index) {
    const int count = static_cast<int>(std::lround(400 * area_index));
    for (int k = 0; k < count; ++k) {
        const glm::dvec3 middle{0.25 + 0.5 * (k % 4), floor + 0.05 + 0.4 * (k + 0.5) / count, 0.25 + 0.5 * (k / 4 % 4)};
        draw_square(geometry, module, middle, {1, 0, 0}, {0, 0, 1}, 0.1);
    }
}

/// Leaves of two modules that send as black bodies of these temperatures.
leaf::PlantLeaves sending_leaves(float area, const std::vector<double>& temperatures) {
    leaf::PlantLeaves leaves;
    leaves.modules_in_string = temperatures.size();
    for (std::uint32_t module = 0; module < temperatures.size(); ++module) leaves.add(module, 0, area);
    leaves.begin(0);
    for (const double temperature : temperatures) leaves.sent.push_back(2 * black_body(temperature));
    leaves.thermal.assign(temperatures.size(), 700);
    return leaves;
}

}  // namespace

// Beams of every direction pass exp(-L) of a layer of level leaves.
TEST_CASE("two large parallel layers of leaves meet what sky, soil and each other send",
          "[leaf-exchange][long-waves]") {
    for (const double index : {0.48, 2.0, 8.0}) {
        AskingPlants plants = plant_of(2);
        draw_layer(plants.interpretation(0).geometry, 0, 2, index);
        draw_layer(plants.interpretation(0).geometry, 1, 0.5, index);
        const Settings table =
            Settings::parse_toml("voxel = 0.5\nperiodic = true\nsoil_emissivity = 1\n", "waves.toml");
        leaf::CanopyWaves waves(table, context_of(1));
        std::vector<leaf::PlantLeaves> leaves{sending_leaves(float(4 * index), {31, 16})};
        const PlantView view{0, nullptr, nullptr, &plants.interpretation(0)};
        waves.lay({1, 1, 1, std::span(&view, 1)}, leaves);
        const leaf::WavesAround around{290, 20, 24, 1};
        waves.exchange(leaves, around);
        const double upper = black_body(31), lower = black_body(16), soil = black_body(24), left = std::exp(-index);
        const double between_down = 290 * left + upper * (1 - left), between_up = soil * left + lower * (1 - left);
        const auto met = [&](double from_above, double from_below, double own) {
            return ((from_above + from_below) * (1 - left) + 2 * own * (index - (1 - left))) / index;
        };
        CHECK(leaves[0].thermal[0] == Approx(met(290, between_up, upper)).epsilon(2e-6));
        CHECK(leaves[0].thermal[1] == Approx(met(between_down, soil, lower)).epsilon(2e-6));
        CHECK(waves.ledger().from_sky == Approx(4 * 290));
        CHECK(waves.ledger().from_soil == Approx(4 * soil));
        CHECK(waves.ledger().to_sky == Approx(4 * (between_up * left + upper * (1 - left))).epsilon(2e-6));
        CHECK(waves.ledger().to_soil == Approx(4 * (between_down * left + lower * (1 - left))).epsilon(2e-6));
        CHECK(std::abs(waves.ledger().closure()) < 1e-12);
    }
}

TEST_CASE("a leaf alone above black soil meets the sky's radiation and the soil's", "[leaf-exchange][long-waves]") {
    Environment environment = environment_of(
        noon + breathing +
            "g0 = 0\nsoil_temperature = 34\nlong_waves = { voxel = 0.5, sky = 260, soil_emissivity = 1 }\n",
        context_of(1));
    AskingPlants plants = plant_of(1);
    draw_square(plants.interpretation(0).geometry, 0, {1.1, 1.3, 0.7}, {1, 0, 0}, {0, 0, 1}, 0.01);
    plants.exchange(environment, 1);
    const double thermal = environment.organ_values("leaves.thermal", 0)->at(0);
    CHECK(thermal == Approx(260 + black_body(34)).epsilon(5e-4));
    const double photons = environment.organ_values("light.flux", 0)->at(0);
    const leaf::Air air{18, 0.6 * leaf::saturation_pressure(18), 1, 400, leaf::sea_level};
    const leaf::GasExchange alone =
        leaf::gas_exchange({}, {photons, 0.25 * photons / leaf::photons_of_joule, thermal}, air);
    CHECK(environment.organ_values("leaves.temperature", 0)->at(0) == Approx(alone.temperature).epsilon(1e-5));
}

TEST_CASE("in an enclosure of one temperature nothing is warmer or colder", "[leaf-exchange][long-waves]") {
    const std::string sky = std::to_string(black_body(18));
    Environment environment = environment_of(
        night + breathing + "g0 = 0\nlong_waves = { voxel = 0.25, rings = 2, sky = " + sky + " }\n", context_of(1));
    AskingPlants plants = plant_of(6);
    for (std::uint32_t module = 0; module < 6; ++module) {
        draw_at_random(plants.interpretation(0).geometry, module, 300, 0.12, module + 4);
    }
    plants.exchange(environment, 1);
    for (std::size_t module = 0; module < 6; ++module) {
        CHECK(environment.organ_values("leaves.temperature", 0)->at(module) == Approx(18).margin(2e-5));
        CHECK(environment.organ_values("leaves.thermal", 0)->at(module) == Approx(2 * black_body(18)).epsilon(1e-6));
    }
}

TEST_CASE("what leaves, soil and sky send is what they absorb", "[leaf-exchange][long-waves]") {
    for (const char* more : {"", ", periodic = true, clumping = 0.7", ", soil_emissivity = 0.8, rings = 5"}) {
        Environment environment = environment_of(
            noon + breathing + "soil_temperature = 29\nwind = 0.2\nlong_waves = { voxel = 0.5" + more + " }\n",
            context_of(2));
        AskingPlants plants = plant_of(4, 2);
        for (std::uint32_t plant = 0; plant < 2; ++plant) {
            for (std::uint32_t module = 0; module < 4; ++module) {
                draw_at_random(plants.interpretation(plant).geometry, module, 150, 0.1, 10 * plant + module);
            }
            plants.interpretation(plant).geometry.internodes.push_back(
                {0, 0, 0, 0, 0, {0.4 + plant, 0, 1}, {0.4 + plant, 2.5, 1}, 0.02, 0.01});
        }
        plants.exchange(environment, 1);
        CHECK(std::abs(of_world(environment, "waves_closure")) < 1e-9);
        CHECK(of_world(environment, "residual") < 1e-10);
        const double lost = of_world(environment, "waves_from_plants") - of_world(environment, "waves_to_plants");
        const double others = of_world(environment, "waves_to_soil") - of_world(environment, "waves_from_soil") +
                              of_world(environment, "waves_to_sky") - of_world(environment, "waves_from_sky");
        CHECK(lost == Approx(others).margin(1e-6));
        CHECK(lost > 0);
    }
}

// Without wind a leaf in the open falls below the air by night; deep in a canopy others keep it warm.
TEST_CASE("by night leaves of the top are colder than those that they cover", "[leaf-exchange][long-waves]") {
    Environment environment = environment_of(
        night + breathing + "wind = 0.3\nlong_waves = { voxel = 0.5, periodic = true }\n", context_of(1));
    AskingPlants plants = plant_of(3);
    draw_layer(plants.interpretation(0).geometry, 0, 2.5, 1.5);
    draw_layer(plants.interpretation(0).geometry, 1, 1.5, 1.5);
    draw_layer(plants.interpretation(0).geometry, 2, 0.5, 1.5);
    plants.exchange(environment, 1);
    const auto temperatures = environment.organ_values("leaves.temperature", 0);
    CHECK(temperatures->at(0) < temperatures->at(1) - 0.5);
    CHECK(temperatures->at(1) < temperatures->at(2));
    CHECK(temperatures->at(2) < 18);
}

TEST_CASE("what a scene says of long waves is one line", "[leaf-exchange][long-waves]") {
    const auto mistake = [](const std::string& lines) {
        try {
            Environment environment = environment_of(night + breathing + lines, context_of(1));
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(mistake("thermal = 700\nlong_waves = {}\n"), Contains("leave out 'thermal' or 'long_waves'"));
    CHECK_THAT(mistake("soil_temperature = 20\n"), Contains("add long_waves = { voxel = 0.2 }"));
    CHECK_THAT(mistake("long_waves = { voxel = 0.3, periodic = true }\n"), Contains("a whole number of voxels"));
    CHECK_THAT(mistake("long_waves = { soil_emissivity = 95 }\n"), Contains("soil_emissivity"));
    CHECK_THAT(mistake("long_waves = { sky = -3 }\n"), Contains("sky"));
}
