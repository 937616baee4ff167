// Values of settings at times, and plants that follow them.
#include "simulation/scene/keyframes.h"

#include "espalier/simulation/world.h"

#include "catch.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <cmath>

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;

namespace {

const char* const model_of_keyframes = R"(#define SIZE 1   /* of a segment; 0..10; m */
#define COUNT 3  /* of segments; 0..100 */
lsystem: 1
derivation length: 4
axiom: S A
S --> S
A --> F(SIZE) A
homomorphism
S --> !(SIZE) G(COUNT)
endlsystem
)";

class Scenes {
public:
    Scenes() { folder_.write("plant.l", model_of_keyframes); }

    Scene scene(const std::string& plant) const {
        return read_scene_text("[[plant]]\nmodel = 'plant.l'\n" + plant, "scene.toml", folder_.path());
    }
    /// The string of the plant after each step.
    std::vector<std::string> strings(const std::string& plant, int steps) const {
        World world(scene(plant));
        world.start();
        std::vector<std::string> strings;
        for (int k = 0; k <= steps; ++k) {
            if (k > 0) world.step();
            strings.push_back(to_text(world.string(0), world.model(0).alphabet));
        }
        return strings;
    }

private:
    TemporaryFolder folder_;
};

const std::string growth = "[[plant.keyframes]]\nname = 'SIZE'\ntimes = [0, 4]\nvalues = [1, 3]\n";

}  // namespace

TEST_CASE("keyframes have their values at their times, and between them those of a line", "[scene]") {
    const Keyframes line{"A", {0, 10, 30}, {5, 7, -1}};
    CHECK(line.at(0) == 5);
    CHECK(line.at(10) == 7);
    CHECK(line.at(30) == -1);
    CHECK(line.at(5) == 6);
    CHECK(line.at(20) == 3);
    CHECK(line.at(-4) == 5);
    CHECK(line.at(99) == -1);
}

TEST_CASE("a spline through keyframes passes through them, has one tangent, and stays between two values", "[scene]") {
    const Keyframes spline{"A", {0, 2, 3, 7, 9}, {0, 1, 5, 5, 2}, true};
    for (std::size_t k = 0; k < 5; ++k) CHECK(spline.at(spline.times[k]) == Approx(spline.values[k]).margin(1e-12));
    const double step = 1e-6;
    for (const double time : {2.0, 3.0, 7.0}) {
        const double before = (spline.at(time) - spline.at(time - step)) / step;
        const double after = (spline.at(time + step) - spline.at(time)) / step;
        CHECK(before == Approx(after).margin(1e-4));
    }
    for (double time = 0; time <= 9; time += 0.01) {
        CHECK(spline.at(time) >= -1e-12);
        CHECK(spline.at(time) <= 5 + 1e-12);
    }
}

TEST_CASE("a model reads the value of the step at hand", "[scene]") {
    const Scenes scenes;
    CHECK(scenes.strings(growth, 4) ==
          std::vector<std::string>{"SA", "SF(1.5)A", "SF(1.5)F(2)A", "SF(1.5)F(2)F(2.5)A", "SF(1.5)F(2)F(2.5)F(3)A"});
    const Keyframes spline{"A", {0, 1, 4}, {1, 1.5, 3}, true};
    const auto smooth = scenes.strings(
        "[[plant.keyframes]]\nname = 'SIZE'\ntimes = [0, 1, 4]\nvalues = [1, 1.5, 3]\n"
        "spline = true\n",
        2);
    CHECK_THAT(smooth[2], Contains("F(" + fmt::format("{:g}", spline.at(2)) + ")"));
}

TEST_CASE("a plant that grows anew has in every segment the value of the step", "[scene]") {
    const Scenes scenes;
    CHECK(scenes.strings("regrow = true\n" + growth, 2) ==
          std::vector<std::string>{"SF(1)F(1)F(1)F(1)A", "SF(1.5)F(1.5)F(1.5)F(1.5)A", "SF(2)F(2)F(2)F(2)A"});
}

TEST_CASE("without keyframes a plant that grows anew has grown before the first step, and stays", "[scene]") {
    const Scenes scenes;
    CHECK(scenes.strings("regrow = true\n", 2) == std::vector<std::string>(3, "SF(1)F(1)F(1)F(1)A"));
}

TEST_CASE("a plant of an age has the values of that time", "[scene]") {
    const Scenes scenes;
    CHECK(scenes.strings("age = 3\n" + growth, 1)[1] == "SF(2.5)A");
}

TEST_CASE("mistakes in keyframes are told with what is allowed", "[scene]") {
    const Scenes scenes;
    const auto keyframes = [&](const std::string& lines) {
        return [=, &scenes] { scenes.scene("[[plant.keyframes]]\n" + lines); };
    };
    CHECK_THROWS_WITH(keyframes("name = 'SIZE'\ntimes = [0, 4, 4]\nvalues = [1, 2, 3]\n")(),
                      Contains("'times' must be one number or more, each greater than the one before"));
    CHECK_THROWS_WITH(keyframes("name = 'SIZE'\ntimes = [0, 4]\nvalues = [1]\n")(),
                      Contains("'values' must have a number for each of the 2 'times', not 1"));
    CHECK_THROWS_WITH(keyframes("name = 'SIZE'\ntimes = [0, 4]\nvalues = [1, 40]\n")(),
                      Contains("must be a number between 0 and 10 m, not 40"));
    CHECK_THROWS_WITH(scenes.scene("define = { SIZE = 2 }\n" + growth),
                      Contains("'SIZE' has a value in 'define' already"));
    CHECK_THROWS_WITH(scenes.scene("age = 3\nregrow = true\n" + growth), Contains("either an 'age' or 'regrow'"));
    CHECK_THROWS_WITH(scenes.scene("age = 3\n"), Contains("no [[plant.keyframes]]"));
}
