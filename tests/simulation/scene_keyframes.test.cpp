// Numbers of processes, of turtles and of geometry stages at times.
#include "espalier/simulation/world.h"

#include "catch.h"
#include "resumed_world.h"
#include "simulation/scene/keyframes.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

using namespace espalier;
using Catch::Contains;

namespace {

/// Answers the number that the scene gives it.
class Dial final : public EnvironmentProcess {
public:
    Dial(Settings& settings, const EnvironmentContext&, Fields&) : value_(settings.number_or("value", 1)) {}
    void answer(const WorldView&, Queries, std::span<Answer> answers, Fields&) override {
        for (Answer& answer : answers) answer[0] = value_;
    }
    std::pair<int, int> query_arity() const override { return {1, 1}; }
    std::vector<ChangingSetting> changing_settings() override {
        return {{"value", Range::between(0, 10), [this](double value) { value_ = value; }}};
    }

private:
    double value_;
};
const Registered<ProcessType> dial{{"test-dial", "answers its value", "value (1)", construct<Dial>}};

class Film {
public:
    Film() {
        folder_.write("plant.l",
                      "environment dial;\nlsystem: 1\nderivation length: 8\naxiom: F(1)?dial(0)\nendlsystem\n");
    }

    Scene scene(const std::string& keyframes) const {
        return read_scene_text(
            "[simulation]\ndt = 0.5\n[[plant]]\nmodel = 'plant.l'\n[plant.turtle]\nline_width = 0.1\n"
            "[[plant.stage]]\nstage = 'stem'\nlength = 1\n[[plant.stage]]\nstage = 'pipe-radii'\n"
            "[environment.dial]\nprocess = 'test-dial'\n" +
                keyframes,
            "scene.toml", folder_.path());
    }

    /// A number of each step.
    std::vector<double> numbers(const std::string& keyframes, const std::function<double(const World&)>& number) const {
        World world(scene(keyframes));
        std::vector<double> all;
        for (int step = 0; step <= 8; ++step) {
            step == 0 ? world.start() : world.step();
            all.push_back(number(world));
        }
        return all;
    }

private:
    TemporaryFolder folder_;
};

std::string table(const std::string& key, const std::string& rest = "times = [0, 2, 4]\nvalues = [1, 3, 2]\n") {
    return "[[keyframes]]\nkey = '" + key + "'\n" + rest;
}

double answer(const World& world) {
    return world.string(0).parameters.back();
}

double length_of_stem(const World& world) {
    const Internode& stem = world.frame().plants[0].interpretation->geometry.internodes.front();
    return glm::distance(stem.base, stem.tip);
}

double width(const World& world) {
    return 2 * world.interpretation(0).geometry.internodes.front().tip_radius;
}

void check_equal(const std::vector<double>& found, const std::vector<double>& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k] == Approx(expected[k]).epsilon(1e-12));
}

// Steps of half a unit of time, from 0 to 4.
const std::vector<double> line{1, 1.5, 2, 2.5, 3, 2.75, 2.5, 2.25, 2};

}  // namespace

TEST_CASE_METHOD(Film, "a process has the values of its keyframes", "[scene]") {
    check_equal(numbers(table("environment.dial.value"), answer), line);
}

TEST_CASE_METHOD(Film, "a geometry stage has the values of its keyframes, and the turtle sees nothing of it",
                 "[scene]") {
    check_equal(numbers(table("plant.0.stage.0.length"), length_of_stem), line);
    const auto drawn = [](const World& world) {
        const Internode& only = world.interpretation(0).geometry.internodes.front();
        return glm::distance(only.base, only.tip);
    };
    check_equal(numbers(table("plant.0.stage.0.length"), drawn), std::vector<double>(9, 1));
}

TEST_CASE_METHOD(Film, "a turtle has the values of its keyframes", "[scene]") {
    check_equal(numbers(table("plant.0.turtle.line_width"), width), line);
    const auto scaled = [](const World& world) { return world.interpretation(0).geometry.internodes[0].tip.y; };
    check_equal(numbers(table("plant.0.turtle.scale"), scaled), line);
}

TEST_CASE_METHOD(Film, "keyframes with a spline have one tangent at their times", "[scene]") {
    const std::string smooth = "times = [0, 2, 4]\nvalues = [1, 3, 4]\nspline = true\n";
    const simulation::Keyframes expected{"", {0, 2, 4}, {1, 3, 4}, true};
    const std::vector<double> found = numbers(table("environment.dial.value", smooth), answer);
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k] == Approx(expected.at(0.5 * double(k))));
    CHECK(found[0] == 1);
    CHECK(found[4] == Approx(3).epsilon(1e-14));
    CHECK(found[8] == 4);
    const double step = 1e-6;
    const double before = (expected.at(2) - expected.at(2 - step)) / step;
    CHECK(before == Approx((expected.at(2 + step) - expected.at(2)) / step).epsilon(1e-4));
}

TEST_CASE_METHOD(Film, "a run that is resumed has the values of its time", "[scene]") {
    const Scene described = scene(table("environment.dial.value") + table("plant.0.stage.0.length"));
    simulation_test::ResumedWorld worlds(described, 3);
    worlds.step();
    CHECK(answer(worlds.resumed) == 3);
    CHECK(answer(worlds.resumed) == answer(worlds.through));
    CHECK(length_of_stem(worlds.resumed) == length_of_stem(worlds.through));
}

TEST_CASE_METHOD(Film, "what cannot change with time is refused with what can", "[scene]") {
    const auto refusal = [&](const std::string& keyframes) {
        try {
            World world(scene(keyframes));
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refusal(table("simulation.dt")),
               Contains("scene.toml:15:1: 'simulation.dt' does not change with time; keyframes change numbers of "
                        "processes (environment.light.strength)"));
    CHECK_THAT(refusal(table("plant.0.define.SIZE")), Contains("[[plant.keyframes]] the #defines of a model"));
    CHECK_THAT(refusal(table("plant.1.stage.0.length")), Contains("does not name one of the 1 [[plant]] tables"));
    CHECK_THAT(refusal(table("plant.0.position")), Contains("does not change with time"));
    CHECK_THAT(refusal(table("environment.dail.value")),
               Contains("the scene has no process 'dail' (did you mean 'dial'?)"));
    CHECK_THAT(
        refusal(table("environment.dial.valve")),
        Contains("'valve' of process 'dial' does not change with time (did you mean 'value'?); what does: value"));
    CHECK_THAT(refusal(table("environment.dial.value", "times = [0, 1]\nvalues = [1, 11]\n")),
               Contains("'environment.dial.value' must be at least 0 and at most 10, not 11"));
    CHECK_THAT(refusal(table("plant.0.stage.0.length", "times = [0, 1]\nvalues = [1, -2]\n")),
               Contains("at the time 1: ") && Contains("'length'"));
    CHECK_THAT(refusal(table("plant.0.stage.0.lenght")), Contains("lenght"));
    CHECK_THAT(refusal(table("plant.0.turtle.colour", "times = [0, 1]\nvalues = [1, 2]\n")),
               Contains("at the time 0.5: ") && Contains("whole number"));
    CHECK_THAT(refusal("[[keyframes]]\nname = 'a'\n"), Contains("'key'"));
}

TEST_CASE("a model whose setting has a value with Q is refused, for nobody gave it one in time", "[scene]") {
    const TemporaryFolder folder;
    folder.write("plant.l", "#define SIZE 1 /* of it; 0..10; m */\nlsystem: 1\naxiom: F(SIZE)\nendlsystem\n");
    CHECK_THROWS_WITH(
        read_scene_text("[[plant]]\nmodel = 'plant.l'\ndefine = { SIZE = 'Q' }\n", "scene.toml", folder.path()),
        Contains("must be a number between 0 and 10 m, not Q"));
}
