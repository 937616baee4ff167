#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

const char* const four_points =
    "[light]\nprocess = 'markers'\ninfluence = 1.5\nkill = 0.6\ncloud = { points = [[-1, 3.5, 0], [1, 3.5, 0], "
    "[1.5, 1, 0], [9, 9, 9]] }\n";

/// A stem of three nodes; the answers of all, four parameters each.
std::vector<double> ask_stem(Environment& environment, std::vector<double> parameters = {0, 0, 0, 0}) {
    AskingPlants plants;
    plants.add({{{0, 1, 0}, parameters}, {{0, 2, 0}, parameters}, {{0, 3, 0}, parameters}}).exchange(environment);
    return plants.parameters();
}

std::string with(const std::string& lines) {
    return "[light]\nprocess = 'markers'\ncloud = { radii = [1, 1, 1] }\n" + lines;
}

}  // namespace

TEST_CASE("a node grows towards the mean of the unit vectors to the points it has won", "[markers]") {
    EnvironmentContext context;
    context.plants = 1;
    Environment environment = environment_of(four_points, context);
    const std::vector<double> answers = ask_stem(environment);
    // The highest node has won the two above it, whose pulls add up to straight up; the lowest the one beside it.
    const std::vector<double> expected{1, 1, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0};
    REQUIRE(answers.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(answers[i] == Approx(expected[i]).margin(1e-12));
    const auto statistics = environment.statistics(0);
    CHECK(statistics[0].name == "light.won");
    CHECK(statistics[0].value == 3);
    CHECK(statistics[1].value == 4);
    CHECK(statistics[2].value == 3);
    CHECK(statistics[3].value == 2);
}

TEST_CASE("two new nodes take two points: the next step has none to win but the farthest", "[markers]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    context.plants = 1;
    Environment environment = environment_of(four_points, context);
    AskingPlants plants;
    plants.add({{{0, 1, 0}, {0}}, {{1, 1, 0}, {0}}, {{0, 3, 0}, {0}}, {{-0.9, 3.5, 0}, {0}}, {{0.6, 3.2, 0}, {0}}})
        .exchange(environment, 1);
    CHECK(environment.statistics(0)[1].value == 1);
    CHECK(plants.parameters() == std::vector<double>{0, 0, 0, 0, 0});
    CHECK(warnings.empty());  // this may be the last step
    plants.exchange(environment, 2);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].message, Contains("step 1: growth has ended: none of the 1 points left"));
}

TEST_CASE("the end of growth is told once: no point left, or none in reach", "[markers]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.warnings = &warnings;
    Environment environment = environment_of(
        "[light]\nprocess = 'markers'\ninfluence = 2\nkill = 1\ncloud = { points = [[0, 1.5, 0]] }\n", context);
    ask_stem(environment);
    ask_stem(environment);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].message, Contains("step 0") && Contains("no point of 'light' is left"));
}

TEST_CASE("a tropism tilts all directions, the more the stronger it is, and 0 changes nothing", "[markers]") {
    double before = 0;
    for (const double strength : {0.0, 0.2, 0.5, 1.0}) {
        Environment environment = environment_of(four_points + std::string("tropism = [0, 0, ") +
                                                 std::to_string(strength) + "]\nweight = [5, 5, 1]\n");
        const std::vector<double> answers = ask_stem(environment);
        CHECK(answers[3] == Approx(strength / std::sqrt(1 + strength * strength)));
        CHECK(glm::length(glm::dvec3(answers[1], answers[2], answers[3])) == Approx(1));
        CHECK(answers[3] >= before);
        before = answers[3];
    }
}

TEST_CASE("points outside the angle of perception do not attract", "[markers]") {
    for (const auto& [degrees, won] : {std::pair{179.0, 0.0}, {181.0, 1.0}}) {
        Environment environment = environment_of(four_points + ("perception = " + std::to_string(degrees)));
        CHECK(ask_stem(environment)[0] == won);  // the point beside the lowest node, 90 degrees off its heading
    }
}

TEST_CASE("a node that is answered its last direction again wins nothing: it has grown there", "[markers]") {
    Environment environment = environment_of(four_points);
    const std::vector<double> answers = ask_stem(environment, {0, 1, 0, 0});
    CHECK(answers[0] == 0);
    CHECK(answers[1] == 1);
    CHECK(answers[8] == 2);
}

TEST_CASE("a query below 0 takes space and wins nothing", "[markers]") {
    Environment environment = environment_of(four_points);
    const std::vector<double> answers = ask_stem(environment, {-1, 0, 0, 0});
    CHECK(answers == std::vector<double>{-1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0});
}

TEST_CASE("the kill distance goes from begin to end along a sigmoid", "[markers]") {
    // One point that goes as soon as the kill distance reaches it: Brzoska 2019, eq. 17 and the values after it.
    const double expected[][2] = {{0, 1.99973}, {14, 1.65483}, {15, 1.54517}, {29, 1.20027}, {40, 1.20027}};
    for (const auto& [step, distance] : expected) {
        for (const double beyond : {-1e-5, 1e-5}) {
            Environment environment = environment_of(
                "[light]\nprocess = 'markers'\ninfluence = 2\nkill = { begin = 2, end = 1.2, steps = 30 }\n"
                "cloud = { points = [[0, " +
                std::to_string(distance + beyond) + ", 0]] }\n");
            AskingPlants plants;
            plants.add({{{0, 0, 0}, {0}}}).exchange(environment, static_cast<int>(step));
            CHECK(environment.statistics(0)[1].value == (beyond > 0 ? 1 : 0));
        }
    }
}

TEST_CASE("distances that make no sense are refused with their key and range", "[markers]") {
    const auto refuses = [](const std::string& lines, const std::string& message) {
        INFO(lines);
        CHECK_THAT(message_of([&] { environment_of(with(lines)); }), Contains(message));
    };
    refuses("influence = 0\nkill = 0.1", "influence");
    refuses("influence = 1", "kill");
    refuses("influence = 1\nkill = 0", "kill");
    refuses("influence = 1\nkill = 1.5", "'kill' (1.5 m) must be at most 'influence' (1 m)");
    refuses("influence = 1\nkill = { begin = 2, end = 1, steps = 3 }", "'begin' (2 m) must be at most");
    refuses("influence = 1\nkill = { begin = 1, end = 1, steps = 1 }", "steps");
    refuses("influence = nan\nkill = 0.5", "influence");
    refuses("influence = 1\nkill = 0.5\nperception = 400", "perception");
}
