#include "espalier/base/file.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// A query of one tip in the pose of the turtle, answered.
std::vector<double> answers(const std::string& lines, const Pose& pose, const std::vector<double>& parameters) {
    EnvironmentContext context;
    context.plants = 1;
    Environment environment = environment_of("[light]\nprocess = \"arvo\"\n" + lines, context);
    AskingPlants plants;
    plants.add({{pose.position, parameters}});
    plants.interpretation(0).queries[0].pose = pose;
    plants.exchange(environment);
    return plants.parameters();
}

Pose pose_at(const glm::dvec3& position, const glm::dvec3& heading, const glm::dvec3& up) {
    return {position, heading, glm::cross(up, heading), up};
}

const char* const ground = "solid = { shape = 'half-space', normal = [0, 1, 0] }\n";
const char* const block = "solid = { shape = 'box', lower = [-1, 0, -1], upper = [1, 2, 1] }\n";
const std::vector<double> wish{0.2, 0, 0, 0, 0, 0, 0};

}  // namespace

TEST_CASE("a segment that meets an obstacle is told, with the normal there; a negative length looks back", "[arvo]") {
    const Pose down = pose_at({3, 1, 0}, {0, -1, 0}, {1, 0, 0});
    CHECK(answers(ground, down, {2}) == std::vector<double>{1});
    CHECK(answers(ground, down, {0.9}) == std::vector<double>{0});
    CHECK(answers(ground, down, {-2}) == std::vector<double>{0});
    const std::vector<double> hit = answers(ground, down, {2, 7, 7, 7});
    CHECK(hit[0] == 1);
    CHECK(glm::distance(glm::dvec3(hit[1], hit[2], hit[3]), {0, 1, 0}) < 1e-9);
    CHECK(answers(ground, down, {0.5, 7, 7, 7}) == std::vector<double>{0, 7, 7, 7});
}

TEST_CASE("on a plane a climber goes straight on, at its distance", "[arvo]") {
    const auto walked = answers(std::string(ground) + "surface_distance = 0.05\ntries_for_surface = 0",
                                pose_at({0, 0.05, 0}, {1, 0, 0}, {0, 1, 0}), wish);
    CHECK(walked[0] == Approx(0.2).epsilon(1e-4));
    CHECK(glm::distance(glm::dvec3(walked[1], walked[2], walked[3]), {1, 0, 0}) < 1e-4);
    CHECK(glm::distance(glm::dvec3(walked[4], walked[5], walked[6]), {0, 1, 0}) < 1e-4);
}

TEST_CASE("before an obstacle a climber turns aside, and far from surfaces it stops", "[arvo]") {
    const std::string walls =
        "solid = { shape = 'union', of = [{ shape = 'half-space', normal = [0, 1, 0] }, "
        "{ shape = 'box', lower = [0.1, 0, -9], upper = [1, 9, 9] }] }\ntries_for_surface = 0";
    const auto aside = answers(walls, pose_at({0, 0.05, 0}, {1, 0, 0}, {0, 1, 0}), wish);
    CHECK(aside[0] > 0.1);
    CHECK(aside[1] * aside[0] < 0.1);
    CHECK(answers(ground, pose_at({0, 9, 0}, {1, 0, 0}, {0, 1, 0}), wish)[0] == 0);
    CHECK(answers("", pose_at({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), wish)[0] == 0);
}

TEST_CASE("a climber goes over the edges of a block and keeps its distance from it", "[arvo]") {
    EnvironmentContext context;
    context.plants = 1;
    Environment environment =
        environment_of(std::string("[light]\nprocess = \"arvo\"\nsurface_distance = 0.05\nmax_surface_distance = "
                                   "0.5\ntries_for_surface = 300\n") +
                           block,
                       context);
    Pose pose = pose_at({1.05, 0.3, 0.1}, {0, 1, 0}, {1, 0, 0});
    bool on_top = false, beyond = false;
    for (int step = 0; step < 40; ++step) {
        AskingPlants plants;
        plants.add({{pose.position, wish}});
        plants.interpretation(0).queries[0].pose = pose;
        plants.exchange(environment, step);
        const std::vector<double> p = plants.parameters();
        REQUIRE(p[0] > 0);
        const glm::dvec3 heading(p[1], p[2], p[3]), up(p[4], p[5], p[6]);
        CHECK(std::abs(glm::dot(heading, up)) < 1e-9);
        pose = pose_at(pose.position + p[0] * heading, heading, up);
        const glm::dvec3 outside = glm::max(glm::abs(pose.position - glm::dvec3(0, 1, 0)) - 1.0, 0.0);
        CHECK(glm::length(outside) == Approx(0.05).margin(1e-4));
        on_top = on_top || pose.position.y > 2.04;
        beyond = beyond || pose.position.x < -1.04;
    }
    CHECK(on_top);
    CHECK(beyond);
}

TEST_CASE("plants place obstacles by a query without parameters before S or C", "[arvo]") {
    EnvironmentContext context;
    context.plants = 1;
    Environment environment = environment_of("[light]\nprocess = \"arvo\"", context);
    const auto is_hit = [&](const char* symbol, const std::vector<double>& sizes, double length) {
        AskingPlants plants;
        plants.add({{{0, 5, 0}, {}}, {{0, 0, 0}, {length}}});
        Query& object = plants.interpretation(0).queries[0];
        object.following = plants.model().alphabet.letter(symbol, static_cast<int>(sizes.size()));
        object.following_parameters = sizes;
        plants.exchange(environment);
        return plants.parameters()[0] == 1;
    };
    CHECK(is_hit("S", {1}, 4.01));
    CHECK_FALSE(is_hit("S", {1}, 3.99));
    CHECK(is_hit("C", {1, 2}, 5.01));
    CHECK_FALSE(is_hit("C", {1, 2}, 4.99));
    CHECK(is_hit("C", {1, 0.5, 2}, 5.01));
    CHECK_FALSE(is_hit("X", {1}, 9));  // nothing stays from step to step
}

TEST_CASE("objects stay when their queries are gone, if the scene keeps them", "[arvo]") {
    EnvironmentContext context;
    context.plants = 1;
    Environment environment = environment_of("[light]\nprocess = \"arvo\"\nkeep_objects = true", context);
    // A ball of 1 m `identity` m above the ground, if any, and then whether a ray upwards meets something.
    const auto is_hit = [](Environment& world, std::uint64_t identity, double height, double length, int step) {
        AskingPlants plants;
        plants.add({{{0, height, 0}, {}}, {{0, 0, 0}, {length}}});
        Query& object = plants.interpretation(0).queries[0];
        const std::vector<double> sizes{1};
        object.identity = identity;
        object.following = plants.model().alphabet.letter(identity > 0 ? "S" : "X", 1);
        object.following_parameters = sizes;
        plants.exchange(world, step);
        return plants.parameters()[0] == 1;
    };
    CHECK(is_hit(environment, 1, 9, 8.01, 0));
    CHECK(is_hit(environment, 0, 0, 8.01, 1));  // it stays
    CHECK(is_hit(environment, 2, 5, 4.01, 2));
    CHECK(is_hit(environment, 2, 7, 6.01, 3));  // its query moves the second
    CHECK_FALSE(is_hit(environment, 0, 0, 5.9, 4));
    std::stringstream checkpoint;
    environment.save(checkpoint);
    Environment restored = environment_of("[light]\nprocess = \"arvo\"\nkeep_objects = true", context);
    restored.restore(checkpoint);
    CHECK(is_hit(restored, 0, 0, 6.01, 5));
    CHECK_FALSE(is_hit(restored, 0, 0, 5.9, 6));
}

TEST_CASE("the parameter file of cpfg's program names a file of obstacles", "[arvo]") {
    const TemporaryFolder folder;
    write_text(folder.path() / "stones.dat", "polygon\n-1 2 -1\n1 2 -1\n0 2 1\n");
    write_text(folder.path() / "climb.spec",
               "domain size: 9 9 9\nsurface distance: 0.1\nmax surface distance: 2\nobstacles: stones.dat\n");
    const std::string lines = "parameters = '" + (folder.path() / "climb.spec").string() + "'";
    const Pose up = pose_at({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    CHECK(answers(lines, up, {2.1}) == std::vector<double>{1});
    CHECK(answers(lines, up, {1.9}) == std::vector<double>{0});
}

TEST_CASE("a surface distance of 0 is a mistake", "[arvo]") {
    const std::string message = message_of([] { answers("surface_distance = 0", {}, {1}); });
    CHECK(lacks(message, {"'surface_distance'"}) == "");
}
