// Expressions of a scene in the #defines of its models.
#include "espalier/simulation/scene.h"
#include "espalier/simulation/world.h"

#include "catch.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

using namespace espalier;
using Catch::Contains;

namespace {

const char* const model_of_expressions = R"(/* A row of internodes. */
#define WIDTH 6    /* width; 1..20; m */
#define GNARLY 0.5 /* how crooked; 0..1 */
#define ON 0
#define D 0.25
#define REACH (D * (3 + 9 * (1 - GNARLY)))

lsystem: 1
derivation length: 2
axiom: FA
A --> F A
endlsystem
)";

struct ScenesOfRows {
    ScenesOfRows() {
        folder.write("row.l", model_of_expressions);
        folder.write("other.l", std::string("#define LEAN 0\n") + model_of_expressions);
    }
    Scene read(const std::string& text, const SceneOptions& options = {}) const {
        return read_scene_text(text, "scene.toml", folder.path(), options);
    }
    std::string message(const std::string& text) const {
        try {
            read(text);
        } catch (const UserError& error) {
            return error.what();
        }
        return "no error";
    }
    TemporaryFolder folder;
};

const std::string row = "[[plant]]\nmodel = 'row.l'\n";

}  // namespace

TEST_CASE_METHOD(ScenesOfRows, "processes read numbers where the scene has expressions in the model's settings",
                 "[simulation]") {
    const Scene scene = read(row + "define = { WIDTH = 8 }\n[environment.light]\nprocess = 'voxel-shade'\n" +
                             "voxel = '= D'\nstrength = '= REACH / WIDTH'\n[timeline]\nevery = '= 2 * 3'\n");
    const World world(scene);
    const auto resolved = nlohmann::json::parse(scene.root.resolved_json());
    CHECK(resolved["environment"]["light"]["voxel"] == 0.25);
    CHECK(resolved["environment"]["light"]["strength"] == 0.25 * 7.5 / 8);
    CHECK(resolved["timeline"]["every"] == 6);
}

TEST_CASE_METHOD(ScenesOfRows, "an expression follows what --set says of the settings", "[simulation]") {
    const std::string text = row + "[simulation]\nsteps = '= WIDTH + 1'\n";
    CHECK(read(text).steps == 7);
    CHECK(read(text, {.overrides = {{"plant.0.define.WIDTH", "3"}}, .steps = {}, .seed = {}}).steps == 4);
    CHECK(read(text, {.overrides = {{"simulation.dt", "= D"}}, .steps = {}, .seed = {}}).dt == 0.25);
}

TEST_CASE_METHOD(ScenesOfRows, "stages and turtle read the settings of their own plant", "[simulation]") {
    const Scene scene = read(row + "[plant.turtle]\nangle = '= WIDTH * 10'\n[[plant]]\nmodel = 'other.l'\n" +
                             "define = { WIDTH = 2 }\n[plant.turtle]\nangle = '= WIDTH * 10 + LEAN'\n" +
                             "[[plant.stage]]\nstage = 'pipe-radii'\ntip = '= D / WIDTH'\n");
    CHECK(scene.plants[0].turtle.angle == Approx(std::acos(-1) / 3));
    CHECK(scene.plants[1].turtle.angle == Approx(std::acos(-1) / 9));
    REQUIRE(scene.plants[1].stages.size() == 1);
    CHECK_THAT(scene.root.resolved_json(), Contains("\"tip\": 0.125"));
}

TEST_CASE_METHOD(ScenesOfRows, "a stage is left out where `when` is false or 0", "[simulation]") {
    const auto stages = [&](const std::string& when) {
        return read(row + "[[plant.stage]]\nstage = 'pipe-radii'\ntip = 0.01\n" + when).plants[0].stages.size();
    };
    CHECK(stages("") == 1);
    CHECK(stages("when = true\n") == 1);
    CHECK(stages("when = '= WIDTH > 5'\n") == 1);
    CHECK(stages("when = false\n") == 0);
    CHECK(stages("when = '= ON'\n") == 0);
    CHECK(stages("when = '= ON'\nexponent = '= -1'\n") == 0);
    CHECK_THAT(message(row + "[[plant.stage]]\nstage = 'pipe-radii'\nwhen = '= WIDTH'\n"),
               Contains("scene.toml:5:1: ") && Contains("'when' must be true or false"));
}

TEST_CASE_METHOD(ScenesOfRows, "an expression without a value is an error at its place, with the nearest name",
                 "[simulation]") {
    CHECK_THAT(message(row + "[environment.light]\nvoxel = '= REECH'\n"),
               Contains("scene.toml:4:1: ") && Contains("the expression of 'voxel'") && Contains("'REECH'") &&
                   Contains("did you mean 'REACH'?"));
    CHECK_THAT(message(row + "[timeline]\nkeyframes = [1, '= 1 / ON']\n"),
               Contains("scene.toml:4:17: ") && Contains("'keyframes'") && Contains("no finite value"));
    // Both of two mistakes are told.
    CHECK_THAT(message(row + "[timeline]\nfirst = '= (1'\nevery = '= X'\n"),
               Contains("'first'") && Contains("'every'"));
    // The value computed is out of range where the process or the scene reads it.
    CHECK_THAT(message(row + "[simulation]\ndt = '= ON'\n"), Contains("scene.toml:4:1: 'dt' must be greater than 0"));
}

TEST_CASE_METHOD(ScenesOfRows, "an error about a computed value names the settings that it was computed from",
                 "[simulation]") {
    CHECK_THAT(message(row + "[[plant.stage]]\nstage = 'pipe-radii'\ntip = '= REACH * GNARLY - 10'\n"),
               Contains("scene.toml:5:1: 'tip' must be greater than 0, not -9.") && Contains("(computed from GNARLY)"));
    const Scene scene = read(row + "[environment.light]\nprocess = 'voxel-shade'\nvoxel = '= 0 * REACH'\n");
    CHECK_THROWS_WITH(World(scene), Contains("'voxel'") && Contains("(computed from GNARLY)"));
}

TEST_CASE_METHOD(ScenesOfRows, "mistakes of the model are told once, and a missing model as ever", "[simulation]") {
    const std::string expressions = "[timeline]\nfirst = '= D'\nevery = '= D'\n";
    CHECK_THAT(message("[[plant]]\nmodel = 'no.l'\n" + expressions), Contains("there is no model"));
    const std::string text = message(row + "define = { WIDTH = 21 }\n" + expressions);
    CHECK_THAT(text, Contains("row.l:2:1: the setting 'WIDTH' (width) must be a number between 1 and 20 m, not 21"));
    CHECK(text.find("setting") == text.rfind("setting"));
}

TEST_CASE_METHOD(ScenesOfRows, "a define of a scene outside the range of a setting is refused", "[simulation]") {
    CHECK_THAT(message(row + "define = { GNARLY = 1.5 }\n"),
               Contains("the setting 'GNARLY' (how crooked) must be a number between 0 and 1, not 1.5"));
    CHECK(message(row + "define = { GNARLY = 1, D = 1000 }\n") == "no error");
}

TEST_CASE_METHOD(ScenesOfRows, "places and spacings of plants are expressions in their own model's settings",
                 "[simulation]") {
    const Scene scene = read(
        "[[plant]]\nmodel = 'row.l'\nposition = ['= WIDTH / 2', 0, '= -WIDTH']\n"
        "grid = { columns = '= 1 + 1', spacing = '= 2 * D' }\n"
        "[[plant]]\nmodel = 'row.l'\ndefine = { WIDTH = 8 }\nroll = '= WIDTH'\n"
        "positions = [['= WIDTH', 1, 0], [0, '= D', 2]]\n");
    REQUIRE(scene.plants.size() == 4);
    CHECK(scene.plants[0].turtle.pose.position == glm::dvec3(2.75, 0, -6));
    CHECK(scene.plants[1].turtle.pose.position == glm::dvec3(3.25, 0, -6));
    CHECK(scene.plants[2].turtle.pose.position == glm::dvec3(8, 1, 0));
    CHECK(scene.plants[3].turtle.pose.position == glm::dvec3(0, 0.25, 2));
}

TEST_CASE_METHOD(ScenesOfRows, "a key with * says the same of all plants", "[simulation]") {
    SceneOptions options;
    options.overrides = {{"plant.*.define.WIDTH", "12"}};
    const Scene scene = read(
        "[[plant]]\nmodel = 'row.l'\nposition = ['= WIDTH', 0, 0]\n"
        "[[plant]]\nmodel = 'other.l'\nposition = ['= WIDTH / 2', 0, 0]\n",
        options);
    CHECK(scene.plants[0].turtle.pose.position.x == 12);
    CHECK(scene.plants[1].turtle.pose.position.x == 6);
}
