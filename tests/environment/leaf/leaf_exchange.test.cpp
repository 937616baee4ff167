// Leaves in the light that another process measures: they take and give what one leaf alone does, by their areas.
#include "catch.h"
#include "environment/leaf/gas/gas_exchange.h"
#include "environment/light/lit_leaves.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

const std::string light = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\n" + black +
                          "sky = { par = 1200, diffuse = 0, sun = [0, 1, 0] }\n";
const std::string leaves = "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\n";

Environment scene(const std::string& tables) {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 2;
    return environment_of(tables, context);
}

/// One level leaf of 4 cm2, far from others.
AskingPlants one_leaf() {
    AskingPlants plants;
    plants.add({{{0.2, 1, 0.1}, {0, 0, 0}}, {{0, 0, 0}, {0}}});
    draw_square(plants.interpretation(0).geometry, 1, {0.2, 1, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.02);
    return plants;
}

double of_leaf(const Environment& environment, const std::string& quantity) {
    return environment.organ_values("leaves." + quantity, 0)->at(1);
}

double of_plant(const Environment& environment, const std::string& quantity) {
    return environment.statistic("leaves." + quantity, 0);
}

}  // namespace

TEST_CASE("a leaf in a scene does what one leaf alone does in the same light", "[leaf-exchange]") {
    Environment environment =
        scene(light + leaves + "nir = 0.3\nthermal = 790\nwind = 1.5\ng0 = 0\ntemperature = 24\n");
    AskingPlants plants = one_leaf();
    plants.exchange(environment, 1);
    const double photons = environment.organ_values("light.flux", 0)->at(1);
    leaf::LeafKind kind;
    const leaf::Air air{24, 0.6 * leaf::saturation_pressure(24), 1.5, 400, leaf::sea_level};
    const leaf::GasExchange alone = leaf::gas_exchange(kind, {photons, 0.3 * photons / 4.57, 790}, air);
    CHECK(of_leaf(environment, "assimilation") == Approx(alone.assimilation).epsilon(1e-5));
    CHECK(of_leaf(environment, "transpiration") == Approx(1000 * alone.transpiration).epsilon(1e-5));
    CHECK(of_leaf(environment, "temperature") == Approx(alone.temperature).epsilon(1e-6));
    CHECK(of_plant(environment, "leaf_area") == Approx(4e-4).epsilon(1e-6));
    CHECK(of_plant(environment, "gain") == Approx(alone.assimilation * 1e-6 * 4e-4 * 86400).epsilon(1e-5));
    CHECK(of_plant(environment, "residual") < 1e-10);
}

TEST_CASE("at night leaves lose carbon and keep their water", "[leaf-exchange]") {
    const std::string night = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { latitude = 80, day = 355 }\n";
    Environment environment = scene(night + leaves + "g0 = 0\n");
    AskingPlants plants = one_leaf();
    plants.exchange(environment, 1);
    CHECK(of_plant(environment, "gain") < 0);
    CHECK(of_plant(environment, "water") == 0);
}

TEST_CASE("nothing is gained before time has passed", "[leaf-exchange]") {
    Environment environment = scene(light + leaves);
    AskingPlants plants = one_leaf();
    plants.exchange(environment, 0);
    CHECK(of_plant(environment, "gain") == 0);
    CHECK(of_leaf(environment, "assimilation") > 5);
}

namespace {

/// Level leaves of 1 dm2 between the heights 0 and 1.5 m, as many in each column of voxels: a leaf area index of 3.
AskingPlants level_leaves(std::uint64_t seed) {
    AskingPlants plants;
    std::vector<Asked> questions(1200, Asked{{0, 0, 0}, {0}});
    plants.add(questions);
    for (std::uint32_t k = 0; k < 1200; ++k) {
        const double height = 1.5 * static_cast<double>(mix(k, seed) >> 11) * 0x1p-53;
        const glm::dvec3 middle{0.25 + 0.5 * (k % 4), height, 0.25 + 0.5 * (k / 4 % 4)};
        draw_square(plants.interpretation(0).geometry, k, middle, {1, 0, 0}, {0, 0, 1}, 0.1);
    }
    return plants;
}

/// Over 4 m2 of ground, mol in a day under a sun in the zenith.
double gain_of_canopy(const std::string& of_leaves, std::uint64_t seed) {
    Environment environment = scene("[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nperiodic = true\n" + black +
                                    "sky = { par = 1200, diffuse = 0, sun = [0, 1, 0] }\n" + leaves +
                                    "nir = 0\ng0 = 0\nthermal = 790\n" + of_leaves);
    AskingPlants plants = level_leaves(seed);
    plants.exchange(environment, 1);
    return of_plant(environment, "gain");
}

}  // namespace

// Leaves of voxels half a metre wide: by Beer's law 1 - exp(-3) of the ground's area are in the sun, and no leaf is
// half lit.
TEST_CASE("a canopy gains what its sunlit and its shaded leaves gain", "[leaf-exchange]") {
    const leaf::Air air{25, 0.6 * leaf::saturation_pressure(25), 1, 400, leaf::sea_level};
    const double sun = leaf::gas_exchange({}, {1200, 0, 790}, air).assimilation;
    const double shade = leaf::gas_exchange({}, {0, 0, 790}, air).assimilation;
    const double sunlit = 1 - std::exp(-3.0), expected = 4 * (sunlit * sun + (3 - sunlit) * shade) * 1e-6 * 86400;
    for (const std::uint64_t seed : {3, 8}) {
        CHECK(gain_of_canopy("", seed) == Approx(expected).epsilon(0.002));
        CHECK(gain_of_canopy("sunlit = false\n", seed) > 1.3 * expected);
    }
}

TEST_CASE("what leaves say of the scene is one line", "[leaf-exchange]") {
    const auto mistake = [](const std::string& tables) {
        try {
            Environment environment = scene(tables);
            AskingPlants plants = one_leaf();
            plants.exchange(environment, 1);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(mistake(leaves + light), Contains("needs a canopy-light or a ray-light called 'light', before it"));
    CHECK_THAT(mistake(light + leaves + "humidity = 60\n"), Contains("write 0.6 for 60 %"));
    CHECK_THAT(mistake(light + leaves + "co2 = 40\n"), Contains("40 Pa at sea level are 400"));
    CHECK_THAT(mistake(light + leaves + "wind = -1\n"), Contains("write 0.1 for calm air"));
    CHECK_THAT(mistake(light + "[leaves]\nprocess = \"leaf-exchange\"\n"), Contains("write light = \"light\""));
    CHECK_THAT(mistake(light + leaves + "roots = \"roots\"\n"),
               Contains("scene.toml:") && Contains("[environment.roots] with process = \"root-water\" above it"));
    CHECK_THAT(mistake(light + leaves + "air = \"air\"\n"), Contains("[environment.air] with process = \"weather\""));
    CHECK_THAT(mistake(light + "[roots]\nprocess = \"root-water\"\nradial = 1e-4\naxial = 1\n"),
               Contains("scene.toml:") && Contains("[environment.water] with process = \"soil-water\" above it"));
    CHECK_THAT(mistake(light + "[salt]\nprocess = \"nutrient\"\nsoil = \"mud\"\n"),
               Contains("[environment.mud] with process = \"soil-water\" above it"));
}
