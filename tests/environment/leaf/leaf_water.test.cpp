// How a leaf's transpiration follows its water potential, and what the combination equation makes of it.
#include "catch.h"
#include "environment/leaf/gas/gas_exchange.h"
#include "environment/leaf/gas/penman_monteith.h"
#include "environment/light/lit_leaves.h"

#include <cmath>
#include <random>

using namespace espalier;
using namespace espalier::environment::leaf;
using Catch::Contains;

namespace {

LeafKind closing_leaf(Stomata::Form form = Stomata::Form::medlyn) {
    LeafKind leaf;
    leaf.stomata.form = form;
    if (form != Stomata::Form::medlyn) leaf.stomata.slope = 9;
    leaf.stomata.least = 0.005;
    leaf.stomata.sensitivity = 3;
    leaf.stomata.reference = -1.5;
    return leaf;
}

const Air dry_air{27, 1.3, 1.2, 400, 99};

}  // namespace

TEST_CASE("transpiration falls with the water potential, as its slope says", "[leaf]") {
    for (const Stomata::Form form : {Stomata::Form::medlyn, Stomata::Form::leuning, Stomata::Form::ball_berry}) {
        const LeafKind leaf = closing_leaf(form);
        for (const double photons : {80.0, 500.0, 1600.0}) {
            const LeafLight light{photons, 0.3 * photons / photons_of_joule, 780};
            double before = 1;
            for (double potential = -0.2; potential > -8; potential -= 0.4) {
                INFO(photons << " at " << potential);
                const SlopingExchange found = sloping_gas_exchange(leaf, light, dry_air, potential);
                CHECK(found.leaf.transpiration == gas_exchange(leaf, light, dry_air, potential).transpiration);
                CHECK(found.leaf.transpiration <= before * (1 + 1e-12));
                before = found.leaf.transpiration;
                const double step = 1e-4;
                const double slope = (gas_exchange(leaf, light, dry_air, potential + step).transpiration -
                                      gas_exchange(leaf, light, dry_air, potential - step).transpiration) /
                                     (2 * step);
                CHECK(found.transpiration_by_potential == Approx(slope).epsilon(2e-3).margin(1e-9));
            }
        }
    }
}

TEST_CASE("a leaf that has dried keeps what water it has", "[leaf]") {
    LeafKind leaf = closing_leaf();
    leaf.stomata.dry = -4;
    const LeafLight light{1200, 80, 780};
    CHECK(leaf.stomata.opening({}, -4) == 0.005);
    CHECK(leaf.stomata.opening({}, -6) == Approx(0.005 * std::exp(-4)));
    const double wilted = gas_exchange(leaf, light, dry_air, -4).transpiration;
    CHECK(gas_exchange(leaf, light, dry_air, -9).transpiration < 1e-3 * wilted);
    CHECK(residuals_of(gas_exchange(leaf, light, dry_air, -6), leaf, light, dry_air, -6).largest() < 1e-10);
}

TEST_CASE("Penman and Monteith's equation is the leaf's own where it is about as warm as the air", "[leaf]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<> unit(0, 1);
    int compared = 0;
    for (int trial = 0; trial < 40; ++trial) {
        LeafKind leaf = closing_leaf();
        leaf.width = 0.01 + 0.05 * unit(random);
        const Air air{10 + 20 * unit(random), 0, 1 + 4 * unit(random), 400, 95 + 6 * unit(random)};
        Air moist = air;
        moist.vapour_pressure = (0.3 + 0.5 * unit(random)) * saturation_pressure(air.temperature);
        const double black = black_body(air.temperature), photons = 900 * unit(random);
        const LeafLight light{photons, 0.2 * photons / photons_of_joule, (1.6 + 0.4 * unit(random)) * black};
        const GasExchange found = gas_exchange(leaf, light, moist);
        INFO("leaf " << found.temperature << ", air " << air.temperature);
        // The equation is linear in the difference of temperatures.
        const double warmth = std::abs(found.temperature - air.temperature);
        if (warmth > 3) continue;
        ++compared;
        CHECK(penman_monteith(leaf, light, moist, found.conductance) ==
              Approx(found.transpiration).epsilon(0.005 + 0.007 * warmth));
    }
    CHECK(compared > 15);
    CHECK(penman_monteith(closing_leaf(), {500, 30, 780}, dry_air, 0) == 0);
}

TEST_CASE("one big leaf gains more than the leaves that it stands for, and is told on request", "[leaf-exchange]") {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 1;
    const std::string tables =
        "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { par = 1500, diffuse = 0, sun "
        "= [0, 1, 0] }\n[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\n";
    Environment compared = environment_of(tables + "canopy = \"big-leaf\"\n", context);
    Environment plain = environment_of(tables, context);
    for (Environment* environment : {&compared, &plain}) {
        AskingPlants plants;
        std::vector<Asked> questions(600, Asked{{0, 0, 0}, {0}});
        plants.add(questions);
        for (std::uint32_t k = 0; k < 600; ++k) {
            const glm::dvec3 middle{0.25 + 0.5 * (k % 4), 0.1 + 0.0023 * k, 0.25 + 0.5 * (k / 4 % 4)};
            draw_square(plants.interpretation(0).geometry, k, middle, {1, 0, 0}, {0, 0, 1}, 0.1);
        }
        plants.exchange(*environment, 1);
    }
    const auto of = [&](const char* name) { return compared.statistic(std::string("leaves.") + name, 0); };
    CHECK(of("big_gain") > 1.1 * of("gain"));
    CHECK(of("penman_monteith") == Approx(of("transpiration")).epsilon(0.05));
    CHECK(std::isnan(of("fao56")));  // no weather
    CHECK(std::isnan(plain.statistic("leaves.big_gain", 0)));
    CHECK(plain.statistic("leaves.gain", 0) == of("gain"));
}

TEST_CASE("some plants have other leaves, by their numbers", "[leaf-exchange]") {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 2;
    const std::string tables =
        "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { par = 1500, diffuse = 0, sun "
        "= [0, 1, 0] }\n[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nv = 70\n";
    const auto gains = [&](const std::string& kinds) {
        Environment environment = environment_of(tables + kinds, context);
        AskingPlants plants;
        plants.add({{{0.2, 1, 0.1}, {0}}});
        plants.add({{{1.2, 1, 0.1}, {0}}});
        draw_square(plants.interpretation(0).geometry, 0, {0.25, 1, 0.25}, {1, 0, 0}, {0, 0, 1}, 0.02);
        draw_square(plants.interpretation(1).geometry, 0, {1.25, 1, 0.25}, {1, 0, 0}, {0, 0, 1}, 0.02);
        plants.exchange(environment, 1);
        return std::pair{environment.statistic("leaves.gain", 0), environment.statistic("leaves.gain", 1)};
    };
    const auto alike = gains(""), other = gains("kinds = [{ plants = [1], g1 = 2 }]\n");
    CHECK(alike.first == Approx(alike.second).epsilon(1e-6));
    CHECK(other.first == alike.first);
    CHECK(other.second < 0.97 * alike.second);
    CHECK_THROWS_WITH(gains("kinds = [{ plants = [2], g1 = 2 }]\n"),
                      Contains("there is no plant 2: they are numbered from 0 to 1"));
}
