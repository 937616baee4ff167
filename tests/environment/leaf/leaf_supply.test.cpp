// Leaves to which roots bring water through a stem: soil, roots, stem and leaves at once.
#include "catch.h"
#include "environment/leaf/gas/gas_exchange.h"
#include "environment/light/lit_leaves.h"

#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

const std::string sunshine = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.25\n" + black +
                             "sky = { par = 1000, diffuse = 0, sun = [0, 1, 0] }\n";
const std::string loam =
    "[water]\nprocess = \"soil-water\"\nmodel = \"richards\"\ndomain = { lower = [-0.1, -0.3, -0.1], upper = [0.1, 0, "
    "0.1] }\nvoxel = 0.05\nsoil = \"loam\"\ndays = 0.0416666666666667\n";
const std::string moist_loam = "initial = { head = -100 }\n", dry_loam = "initial = { head = -4000 }\n";
const std::string taproot = "[roots]\nprocess = \"root-water\"\nradial = 5e-3\naxial = 50\n";
const std::string wood = "stem = { conductivity = 2, b = 2.5, c = 3 }\n";
const std::string drawing =
    "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nroots = \"roots\"\nsf = 4\npsi_f = -1\n"
    "days = 0.0416666666666667\ntemperature = 27\n";

Environment supplied_scene(const std::string& tables, std::uint32_t plants = 1) {
    EnvironmentContext context;
    context.domain = Box{{-0.5, 0, -0.5}, {0.5, 1, 0.5}};
    context.plants = plants;
    return environment_of(tables, context);
}

/// A taproot of 25 cm, a stem of 30 cm, and a level leaf of so many cm2 on it.
void add_drinker(AskingPlants& plants, double x, double area, bool has_root = true) {
    const std::vector<Asked> modules(3, Asked{{x, 0, 0}, {0}});
    plants.add(modules);
    PlantGeometry& geometry = plants.interpretation(plants.count() - 1).geometry;
    if (has_root) geometry.internodes.push_back({0, 0, 0, 0, 0, {x, 0, 0}, {x, -0.25, 0}, 0.002, 0.002});
    geometry.internodes.push_back({1, 1, 0, 0, 0, {x, 0, 0}, {x, 0.3, 0}, 0.003, 0.003});
    geometry.axes = 2;
    draw_square(geometry, 2, {x, 0.3, 0}, {1, 0, 0}, {0, 0, 1}, 0.01 * std::sqrt(area));
}

struct Hours {
    double taken = 0, given = 0, soil = 0, potential = 0, transpiration = 0, residual = 0, balance = 0;
};

Hours hours_after(Environment& environment, AskingPlants& plants, int hours) {
    Hours found;
    for (int step = 0; step <= hours; ++step) {
        plants.exchange(environment, step);
        const auto of = [&](const char* name) { return environment.statistic(name, 0); };
        found.given += of("leaves.water");
        found.residual = std::max(found.residual, of("leaves.residual"));
        found.balance = std::max(found.balance, std::abs(of("roots.water_balance")));
        found.taken = of("roots.total");
        found.soil = 40 * of("water.drunk");  // mm over 400 cm2
        found.potential = of("leaves.potential");
        found.transpiration = of("leaves.transpiration");
    }
    return found;
}

Hours of_drinker(const std::string& tables, int hours = 12, double area = 100) {
    Environment environment = supplied_scene(tables);
    AskingPlants plants;
    add_drinker(plants, 0, area);
    return hours_after(environment, plants, hours);
}

}  // namespace

TEST_CASE("what a leaf gives is what its roots take is what the soil loses, wet and dry", "[leaf-supply]") {
    for (const std::string& state : {moist_loam, dry_loam}) {
        for (const double area : {20.0, 100.0, 400.0}) {
            const Hours found = of_drinker(sunshine + loam + state + taproot + wood + drawing, 12, area);
            CHECK(found.given > 0);
            CHECK(found.taken == Approx(found.given).epsilon(1e-10));
            CHECK(found.soil == Approx(found.given).epsilon(1e-9));
            CHECK(found.balance < 1e-11);
            CHECK(found.residual < 1e-10);
        }
    }
}

TEST_CASE("organs that store water give it first, and the balance counts it", "[leaf-supply]") {
    const std::string store =
        "stem = { conductivity = 2, b = 2.5, c = 3, capacitance = 300 }\nleaf = { conductance = 8, "
        "capacitance = 3 }\n";
    const Hours with = of_drinker(sunshine + loam + dry_loam + taproot + store + drawing, 4);
    const Hours without = of_drinker(sunshine + loam + dry_loam + taproot + wood + drawing, 4);
    CHECK(with.given > with.taken + 1e-3);
    CHECK(with.given > without.given);
    CHECK(with.balance < 1e-11);
}

TEST_CASE("a leaf is at the potential that the way of its water leaves it", "[leaf-supply]") {
    // The collar's potential and the flow give the leaf's: no conductance is lost here, and leaf and stem are two
    // resistances.
    Environment environment =
        supplied_scene(sunshine + loam + moist_loam + taproot +
                       "stem = { conductivity = 2, b = 0 }\nleaf = { conductance = 8, b = 0 }\n" + drawing);
    AskingPlants plants;
    add_drinker(plants, 0, 100);
    hours_after(environment, plants, 3);
    const double flow = environment.organ_values("roots.flow", 0)->at(2);  // cm3/d
    const double kilogram_of_day = 0.998e-3 / 86400;
    const double mole_of_day = kilogram_of_day / 0.018015;
    const double of_stem = flow * kilogram_of_day * 0.3 / (2 * std::numbers::pi * 9e-6);
    const double of_leaf = flow * mole_of_day / (8e-3 * 0.01);
    const double tip = environment.organ_values("roots.head", 0)->at(1) / 10197.16;
    const double leaf = environment.organ_values("leaves.potential", 0)->at(2);
    CHECK(leaf == Approx(environment.organ_values("roots.head", 0)->at(2) / 10197.16).epsilon(1e-5));
    CHECK(tip - leaf == Approx(of_leaf).epsilon(1e-3));
    const double collar = environment.organ_values("roots.head", 0)->at(0) / 10197.16;  // about it, in the root
    CHECK(tip < collar - of_stem);
    CHECK(environment.organ_values("roots.plc", 0)->at(1) == Approx(0).margin(1e-9));
    CHECK(std::isnan(environment.organ_values("roots.flow", 0)->at(0)));
}

TEST_CASE("stomata close as the soil dries, and the run goes on whatever the leaf asks for", "[leaf-supply]") {
    const Hours moist = of_drinker(sunshine + loam + moist_loam + taproot + wood + drawing);
    const Hours parched = of_drinker(sunshine + loam + dry_loam + taproot + wood + drawing);
    CHECK(parched.transpiration < 0.5 * moist.transpiration);
    CHECK(parched.potential < moist.potential - 0.5);
    // A huge leaf on thin wood: more than the ceiling.
    const Hours thirsty = of_drinker(
        sunshine + loam + dry_loam + taproot + "stem = { conductivity = 0.001, b = 1, c = 8 }\n" + drawing, 6, 900);
    CHECK(thirsty.balance < 1e-9);
    CHECK(thirsty.potential < -3);
}

// 400 leaves over 780 roots of 25 cm: what one voxel gives more, roots in all others take less. If Newton's steps of
// the soil do not know that, they end short of the goal, and substeps become many: 45 in these five hours.
TEST_CASE("many roots below many leaves take few substeps of the soil", "[leaf-supply]") {
    constexpr std::uint32_t roots = 780, pieces = 60, leaves = 400, first_leaf = pieces + roots + 1;
    AskingPlants plants;
    plants.add(std::vector<Asked>(first_leaf + leaves, Asked{{0, 0, 0}, {0}}));
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    for (std::uint32_t i = 0; i < pieces; ++i) {
        geometry.internodes.push_back({i, 0, 0, 0, 0, {0, -0.01 * i, 0}, {0, -0.01 * (i + 1), 0}, 0.005, 0.005});
    }
    for (std::uint32_t k = 0; k < roots; ++k) {
        const double turn = 2.4 * k, depth = -0.01 * (k % pieces + 1);
        const glm::dvec3 tip(0.25 * std::cos(turn), depth - 0.02, 0.25 * std::sin(turn));
        geometry.internodes.push_back({pieces + k, 1 + k, 0, 0, 0, {0, depth, 0}, tip, 5e-4, 5e-4});
    }
    geometry.internodes.push_back({pieces + roots, roots + 1, 0, 0, 0, {0, 0, 0}, {0, 0.9, 0}, 0.01, 0.01});
    geometry.axes = roots + 2;
    for (std::uint32_t k = 0; k < leaves; ++k) {
        const double turn = 2.4 * k, out = 0.05 + 5e-4 * k;
        draw_square(geometry, first_leaf + k, {out * std::cos(turn), 0.9, out * std::sin(turn)}, {1, 0, 0}, {0, 0, 1},
                    0.04);
    }
    Environment environment = supplied_scene(
        sunshine +
        "[water]\nprocess = \"soil-water\"\nmodel = \"richards\"\ndomain = { lower = [-0.32, -0.64, -0.32], upper = "
        "[0.32, 0, 0.32] }\nvoxel = 0.04\nsoil = \"loam\"\ninitial = { head = -300 }\ndays = 0.0416666666666667\n" +
        taproot + wood + drawing);
    for (int hour = 0; hour <= 5; ++hour) plants.exchange(environment, hour);
    CHECK(environment.statistic("water.substeps", 0) < 30);
    CHECK(std::abs(environment.statistic("roots.water_balance", 0)) < 1e-11);
}

TEST_CASE("two plants in one soil leave each other less water", "[leaf-supply]") {
    const std::string tables = sunshine + loam + "initial = { head = -500 }\n" + taproot + wood + drawing;
    Environment alone = supplied_scene(tables), shared = supplied_scene(tables, 2);
    AskingPlants one, two;
    add_drinker(one, -0.04, 500);
    add_drinker(two, -0.04, 500);
    add_drinker(two, 0.04, 500);
    const Hours single = hours_after(alone, one, 60), pair = hours_after(shared, two, 60);
    CHECK(pair.given < 0.99 * single.given);
    CHECK(shared.statistic("roots.total", 0) == Approx(shared.statistic("roots.total", 1)).epsilon(1e-6));
}

TEST_CASE("a checkpoint keeps the water of a shoot bit for bit", "[leaf-supply]") {
    const std::string tables =
        sunshine + loam + dry_loam + taproot +
        "stem = { conductivity = 2, capacitance = 300 }\nleaf = { conductance = 8, capacitance = 3 }\n" + drawing;
    Environment through = supplied_scene(tables);
    AskingPlants plants;
    add_drinker(plants, 0, 100);
    for (int step = 0; step <= 3; ++step) plants.exchange(through, step);
    std::stringstream kept;
    through.save(kept);
    Environment resumed = supplied_scene(tables);
    resumed.restore(kept);
    for (int step = 4; step <= 6; ++step) {
        plants.exchange(through, step);
        plants.exchange(resumed, step);
        for (const char* name :
             {"roots.total", "roots.given", "roots.stored", "leaves.gain", "leaves.potential", "water.storage"}) {
            CHECK(through.statistic(name, 0) == resumed.statistic(name, 0));
        }
    }
}

TEST_CASE("what a scene says of water above the collar is one line", "[leaf-supply]") {
    const auto mistake = [](const std::string& tables) {
        try {
            Environment environment = supplied_scene(tables);
            AskingPlants plants;
            add_drinker(plants, 0, 100);
            plants.exchange(environment, 0);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + wood),
               Contains("needs a leaf-exchange with roots = \"roots\""));
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + "collar = { head = -100 }\n" + drawing),
               Contains("give it a stem"));
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + wood + "collar = { head = -100 }\n" + drawing),
               Contains("leave out 'collar'"));
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + wood + "model = \"couvreur\"\n" + drawing),
               Contains("network of roots"));
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + "leaf = { conductance = 8 }\n" + drawing),
               Contains("stem = { conductivity"));
    CHECK_THAT(mistake(sunshine + loam + moist_loam + taproot + wood + drawing + "potential = -1\n"),
               Contains("leave out 'potential'"));
    CHECK_THAT(mistake(loam + moist_loam + sunshine + taproot + wood + drawing),
               Contains("'light' must stand before 'water'"));
    CHECK_THAT(mistake(sunshine + loam + moist_loam +
                       "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nroots = \"water\"\n"),
               Contains("is not a root-water"));
}

TEST_CASE("a plant without roots is warned of, and its leaves are as if they were wet", "[leaf-supply]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.domain = Box{{-0.5, 0, -0.5}, {0.5, 1, 0.5}};
    context.plants = 1;
    context.warnings = &warnings;
    Environment environment = environment_of(sunshine + loam + moist_loam + taproot + wood + drawing, context);
    AskingPlants plants;
    add_drinker(plants, 0, 100, false);
    plants.exchange(environment, 0);
    plants.exchange(environment, 1);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].message, Contains("no root in the soil of 'water'"));
    CHECK(environment.statistic("leaves.gain", 0) > 0);
    CHECK(environment.statistic("leaves.potential", 0) == 0);
}
