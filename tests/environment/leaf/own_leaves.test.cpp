// Leaves of which the model, or the scene by colour, says what they are.
#include "catch.h"
#include "environment/leaf/gas/gas_exchange.h"
#include "environment/light/lit_leaves.h"

#include <cmath>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

const std::string sun_and_leaves = "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\n" + black +
                                   "sky = { par = 1300, diffuse = 0, sun = [0, 1, 0] }\n"
                                   "[leaf]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nnir = 0.2\nthermal = 800\n"
                                   "wind = 2\ntemperature = 22\ng0 = 0\n";

Environment scene_of_two_leaves(const std::string& lines) {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 1;
    return environment_of(sun_and_leaves + lines, context);
}

/// Two small level leaves, far from each other, and what is asked before each.
AskingPlants two_leaves(const std::vector<double>& first, const std::vector<double>& second) {
    AskingPlants plants({"light", "leaf"});
    plants.add({{{0.2, 1, 0.1}, first, "leaf"}, {{0, 0, 0}, {0}}, {{1.7, 1, 1.6}, second, "leaf"}, {{0, 0, 0}, {0}}});
    draw_square(plants.interpretation(0).geometry, 1, {0.2, 1, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.02, 4);
    draw_square(plants.interpretation(0).geometry, 3, {1.7, 1, 1.6}, {1, 0, 0}, {0, 0, 1}, 0.02, 7);
    return plants;
}

double of_module(const Environment& environment, const std::string& quantity, std::size_t module) {
    return environment.organ_values(quantity, 0)->at(module);
}

/// What a leaf of its own would do in the light that this one gets.
leaf::GasExchange alone(const Environment& environment, std::size_t module, leaf::LeafKind kind) {
    const double photons = of_module(environment, "light.flux", module);
    const leaf::Air air{22, 0.6 * leaf::saturation_pressure(22), 2, 400, leaf::sea_level};
    return leaf::gas_exchange(kind, {photons, 0.2 * photons / leaf::photons_of_joule, 800}, air);
}

leaf::LeafKind kind_with(double v, double jmax, double rd, double g1, double width) {
    leaf::LeafKind kind;
    kind.photosynthesis.carboxylation.at_25 = v;
    kind.photosynthesis.electron_transport.at_25 = jmax;
    kind.photosynthesis.respiration.at_25 = rd;
    kind.stomata.slope = g1;
    kind.width = width;
    return kind;
}

void require_alike(const Environment& environment, std::size_t module, const leaf::LeafKind& kind) {
    const leaf::GasExchange expected = alone(environment, module, kind);
    CHECK(of_module(environment, "leaf.assimilation", module) == Approx(expected.assimilation).epsilon(1e-5));
    CHECK(of_module(environment, "leaf.transpiration", module) == Approx(1000 * expected.transpiration).epsilon(1e-5));
    CHECK(of_module(environment, "leaf.temperature", module) == Approx(expected.temperature).epsilon(1e-6));
}

std::string mistake(const std::string& lines, const std::vector<double>& said) {
    try {
        Environment environment = scene_of_two_leaves(lines);
        AskingPlants plants = two_leaves(said, {0});
        plants.exchange(environment, 1);
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("two leaves of a plant are what their model says of each", "[leaf-exchange][own-leaves]") {
    Environment environment = scene_of_two_leaves("query = [\"v\", \"jmax\", \"g1\", \"width\"]\n");
    AskingPlants plants = two_leaves({35, 70, 2.5, 0.02}, {110, 190, 5, 0.11});
    for (int step = 1; step < 3; ++step) {
        plants.exchange(environment, step);
        require_alike(environment, 1, kind_with(35, 70, 2.12, 2.5, 0.02));
        require_alike(environment, 3, kind_with(110, 190, 2.12, 5, 0.11));
    }
    // What the model says stays as it is in the string.
    const std::vector<double> parameters = plants.parameters();
    CHECK(std::vector(parameters.begin(), parameters.begin() + 4) == std::vector<double>{35, 70, 2.5, 0.02});
}

TEST_CASE("a parameter of 0 is that of the scene, and answers may stand among what is said", "[own-leaves]") {
    Environment environment =
        scene_of_two_leaves("v = 60\njmax = 111\nquery = [\"gain\", \"v\", \"rd\", \"T\", \"g1\"]\n");
    AskingPlants plants = two_leaves({9, 0, 0.7, 9, 0}, {9});
    plants.exchange(environment, 1);
    require_alike(environment, 1, kind_with(60, 111, 0.7, 4, 0.05));
    require_alike(environment, 3, kind_with(60, 111, 2.12, 4, 0.05));
    const std::vector<double> told = plants.parameters();
    CHECK(told[0] == Approx(of_module(environment, "leaf.gain", 1)));
    CHECK(told[1] == 0);
    CHECK(told[2] == 0.7);
    CHECK(told[3] == Approx(of_module(environment, "leaf.temperature", 1)));
    CHECK(told[4] == 0);
}

TEST_CASE("leaves in the dark respire as their model says", "[own-leaves]") {
    const std::string night =
        "[light]\nprocess = \"canopy-light\"\nvoxel = 0.5\nsky = { latitude = 80, day = 355 }\n"
        "[leaf]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nquery = [\"rd\"]\nthermal = 800\n";
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 1;
    Environment environment = environment_of(night, context);
    AskingPlants plants = two_leaves({1}, {3});
    plants.exchange(environment, 1);
    CHECK(of_module(environment, "leaf.gain", 1) < 0);
    CHECK(of_module(environment, "leaf.gain", 3) == Approx(3 * of_module(environment, "leaf.gain", 1)).epsilon(1e-6));
}

TEST_CASE("leaves of a colour are of the kind that names it", "[own-leaves]") {
    Environment environment = scene_of_two_leaves(
        "kinds = [{ colours = [7], v = 30, jmax = 55 }, { plants = [0], colours = [4], g1 = 1.5 }]\n");
    AskingPlants plants = two_leaves({0}, {0});
    plants.exchange(environment, 1);
    require_alike(environment, 1, kind_with(78.5, 150, 2.12, 1.5, 0.05));
    require_alike(environment, 3, kind_with(30, 55, 2.12, 4, 0.05));
}

TEST_CASE("what no leaf has is refused in one line that says what to write", "[own-leaves]") {
    const std::string form = "query = [\"v\", \"jmax\", \"g1\", \"width\"]\n";
    for (const double v : {-3.0, 1e9}) {
        CHECK_THAT(mistake(form, {v}), Contains("'?leaf' of plant 0 says v = ") &&
                                           Contains("write 0 for that of the scene, or above 0 to 1000 umol m-2 s-1"));
    }
    CHECK_THAT(mistake(form, {std::nan("")}), Contains("asks process 'leaf' (leaf-exchange) with the parameter nan"));
    CHECK_THAT(mistake(form, {0, -1}), Contains("jmax = -1") && Contains("above 0 to 2000"));
    CHECK_THAT(mistake(form, {0, 0, 200}), Contains("g1 = 200") && Contains("from 0 to 100"));
    CHECK_THAT(mistake(form, {0, 0, 0, 50}), Contains("width = 50") && Contains("from 0.0001 to 10 m"));
    CHECK_THAT(mistake("v = 1e9\n", {0}), Contains("'v' must be") && Contains("1000"));
    CHECK_THAT(mistake("query = [\"vmax\"]\n", {0}),
               Contains("'vmax' is not what a query may have") && Contains("v, jmax"));
    CHECK_THAT(mistake("query = [\"v\", \"v\"]\n", {0}), Contains("stands there twice"));
    CHECK_THAT(mistake("query = []\n", {0}), Contains("query = [\"gain\"]"));
    CHECK_THAT(mistake("kinds = [{ v = 3 }]\n", {0}), Contains("plants = [1], colours = [4]"));
    CHECK_THAT(mistake("kinds = [{ colours = [-1], v = 3 }]\n", {0}), Contains("no colour -1"));
}
