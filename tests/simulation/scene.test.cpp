#include "espalier/simulation/scene.h"

#include "espalier/simulation/world.h"

#include "catch.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace espalier;
using Catch::Contains;

namespace {

const char* const tree = R"(#define LENGTH 1
lsystem: 1
derivation length: 3
axiom: A
A --> F(LENGTH)[+A]A
endlsystem
)";

class ScenesWithTree {
public:
    ScenesWithTree() { folder_.write("tree.l", tree); }
    Scene read(const std::string& text, const SceneOptions& options = {}) const {
        return read_scene_text(text, "scene.toml", folder_.path(), options);
    }
    std::string message(const std::string& text, const SceneOptions& options = {}) const {
        try {
            read(text, options);
        } catch (const UserError& error) {
            return error.what();
        }
        return "no error";
    }

private:
    TemporaryFolder folder_;
};

std::size_t productions_length(const Plant& plant) {
    return source_of(*plant.model).main().productions.front().successor.size();
}

}  // namespace

TEST_CASE_METHOD(ScenesWithTree, "a scene of one plant needs nothing but its model", "[simulation]") {
    const Scene scene = read("[[plant]]\nmodel = 'tree.l'\n");
    REQUIRE(scene.plants.size() == 1);
    CHECK(scene.plants[0].name == "tree");
    CHECK_FALSE(scene.steps);
    CHECK(World(scene).last_step() == 3);
    CHECK(scene.seed == 0);
    CHECK(scene.plants[0].turtle.pose.heading == glm::dvec3(0, 1, 0));
    CHECK(productions_length(scene.plants[0]) == 6);
}

TEST_CASE_METHOD(ScenesWithTree, "a stand is centred on its position, columns along x and rows along z",
                 "[simulation]") {
    const Scene scene = read(R"(
[[plant]]
model = 'tree.l'
position = [10, 0, 0]
grid = { columns = 3, rows = 2, spacing = 2.0 }
)");
    REQUIRE(scene.plants.size() == 6);
    CHECK(scene.plants[0].turtle.pose.position == glm::dvec3(8, 0, -1));
    CHECK(scene.plants[1].turtle.pose.position == glm::dvec3(10, 0, -1));
    CHECK(scene.plants[5].turtle.pose.position == glm::dvec3(12, 0, 1));
    CHECK(scene.plants[5].name == "tree-6");
    CHECK(scene.plants[5].stream == 5);
}

TEST_CASE_METHOD(ScenesWithTree, "jitter moves plants by less than itself, and the same seed moves them alike",
                 "[simulation]") {
    const std::string text =
        "[simulation]\nseed = 4\n[[plant]]\nmodel = 'tree.l'\n"
        "grid = { columns = 4, rows = 4, spacing = 1.0, jitter = 0.25 }\n";
    const Scene first = read(text), second = read(text);
    double moved = 0;
    for (int i = 0; i < 16; ++i) {
        const glm::dvec3 place = first.plants[i].turtle.pose.position;
        const glm::dvec3 offset = place - glm::dvec3(i % 4 - 1.5, 0, i / 4 - 1.5);
        CHECK(std::max(std::abs(offset.x), std::abs(offset.z)) <= 0.25);
        CHECK(offset.y == 0);
        CHECK(place == second.plants[i].turtle.pose.position);
        moved += glm::length(offset);
    }
    CHECK(moved > 1);
}

TEST_CASE_METHOD(ScenesWithTree, "plants of one model and the same defines share what is compiled", "[simulation]") {
    const Scene scene = read(R"(
[[plant]]
model = 'tree.l'
positions = [[0, 0, 0], [5, 0, 0]]
[[plant]]
model = 'tree.l'
define = { LENGTH = 2 }
[[plant]]
model = 'tree.l'
define = { LENGTH = 2 }
)");
    REQUIRE(scene.plants.size() == 4);
    CHECK(scene.plants[0].model == scene.plants[1].model);
    CHECK(scene.plants[1].model != scene.plants[2].model);
    CHECK(scene.plants[2].model == scene.plants[3].model);
    CHECK(scene.plants[2].name == "tree-2");
    CHECK(scene.plants[3].name == "tree-3");
}

TEST_CASE_METHOD(ScenesWithTree, "heading and roll turn the plant's frame and keep it orthonormal", "[simulation]") {
    const Scene scene = read("[[plant]]\nmodel = 'tree.l'\nheading = [2, 0, 0]\nroll = 30\n");
    const Pose& pose = scene.plants[0].turtle.pose;
    CHECK(glm::distance(pose.heading, glm::dvec3(1, 0, 0)) < 1e-12);
    CHECK(std::abs(glm::dot(pose.heading, pose.left)) < 1e-12);
    CHECK(glm::distance(glm::cross(pose.left, pose.heading), pose.up) < 1e-12);
}

TEST_CASE_METHOD(ScenesWithTree, "overrides reach the simulation, a plant's defines and a process", "[simulation]") {
    const Scene scene = read("[[plant]]\nmodel = 'tree.l'\n[environment.light]\nprocess = 'voxel-shade'\nvoxel = 1.0\n",
                             {{{"plant.0.define.LENGTH", "7"}, {"environment.light.voxel", "0.5"}}, 9, 11});
    CHECK(scene.steps == 9);
    CHECK(scene.seed == 11);
    CHECK(scene.environment.processes.at(0).second.number("voxel") == 0.5);
    Derivation derivation(scene.plants[0].model);
    ModuleString string, next;
    derivation.start(string);
    derivation.step(string, next);
    REQUIRE(next.parameters.size() == 1);
    CHECK(next.parameters[0] == 7);
}

TEST_CASE_METHOD(ScenesWithTree, "processes keep the order of the file", "[simulation]") {
    const Scene scene = read(
        "[[plant]]\nmodel = 'tree.l'\n[environment]\ndefault = 'alpha'\n"
        "[environment.zeta]\nprocess = 'x'\n[environment.alpha]\nprocess = 'y'\n");
    REQUIRE(scene.environment.processes.size() == 2);
    CHECK(scene.environment.processes[0].first == "zeta");
    CHECK(scene.environment.processes[1].first == "alpha");
    CHECK(scene.environment.default_process == "alpha");
}

TEST_CASE_METHOD(ScenesWithTree, "every mistake of a scene is reported at once, with place and nearest name",
                 "[simulation]") {
    const std::string text = message(R"([simulation]
stpes = 4
[[plant]]
modle = 'tree.l'
[[plant]]
model = 'tree.l'
postion = [0, 0, 0]
[enviroment.light]
process = 'voxel-shade'
)");
    CHECK_THAT(text, Contains("scene.toml:2:1: 'stpes' means nothing here (did you mean 'steps'?)"));
    CHECK_THAT(text, Contains("scene.toml:3"));
    CHECK_THAT(text, Contains("'model' is missing"));
    CHECK_THAT(text, Contains("scene.toml:7:1: 'postion' means nothing here (did you mean 'position'?)"));
    CHECK_THAT(text, Contains("scene.toml:8:"));
    CHECK_THAT(text, Contains("(did you mean 'environment'?)"));
}

TEST_CASE_METHOD(ScenesWithTree, "what a scene may not say is named with its place", "[simulation]") {
    const std::string plant = "[[plant]]\nmodel = 'tree.l'\n";
    CHECK_THAT(message(""), Contains("no [[plant]]"));
    CHECK_THAT(message("[[plant]]\nmodel = 'oak.l'\n"),
               Contains("scene.toml:2:1: there is no model") && Contains("oak.l"));
    CHECK_THAT(message(plant + "[simulation]\nsteps = -1\n"), Contains("scene.toml:4:1: 'steps' must be"));
    CHECK_THAT(message(plant + "[simulation]\nsteps = 2.5\n"), Contains("'steps' must be a whole number"));
    CHECK_THAT(message(plant + "[simulation]\ndt = 0\n"), Contains("'dt' must be greater than 0"));
    CHECK_THAT(message(plant + "[simulation]\ndomain = { lower = [0, 0, 0], upper = [1, 0, 1] }\n"),
               Contains("less than"));
    CHECK_THAT(message(plant + "positions = []\n"), Contains("'positions' is empty"));
    CHECK_THAT(message(plant + "positions = [[0, 0]]\n"), Contains("three numbers"));
    CHECK_THAT(message(plant + "position = [0, 0, 0]\npositions = [[0, 0, 0]]\n"), Contains("not both"));
    CHECK_THAT(message(plant + "grid = { columns = 100000, rows = 100000, spacing = 1 }\n"),
               Contains("at most 1000000"));
    CHECK_THAT(message(plant + "heading = [0, 0, 0]\n"), Contains("'heading' must not be zero"));
    CHECK_THAT(message(plant + "turtle = { tropism = [{ direction = [0, 0, 0] }] }\n"), Contains("must not be zero"));
    CHECK_THAT(message(plant + "turtle = { angel = 30 }\n"), Contains("did you mean 'angle'?"));
    CHECK_THAT(message(plant + "name = 'a'\n" + plant + "name = 'a'\n"), Contains("two plants are called 'a'"));
    CHECK_THAT(message(plant + "define = { LENGHT = 2 }\n"), Contains("LENGHT") && Contains("LENGTH"));
    CHECK_THAT(message(plant + "[environment]\ndefault = 'lamp'\n[environment.light]\nprocess = 'x'\n"),
               Contains("'lamp'"));
    CHECK_THAT(message(plant + "[environment]\nlight = 3\n"), Contains("'light' must be a table"));
}

TEST_CASE("a model on its own is a scene", "[simulation]") {
    const TemporaryFolder folder;
    const std::filesystem::path model = folder.write("tree.l", tree);
    const Scene scene = scene_of_model(model, {{{"plant.0.define.LENGTH", "2"}}, 5, {}});
    CHECK(scene.name == "tree");
    CHECK(scene.steps == 5);
    CHECK(scene.plants.size() == 1);
}
