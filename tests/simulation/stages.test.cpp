// Geometry stages change what is recorded of a plant and what light falls on, and nothing else.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "recorded_files.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <cstring>
#include <map>
#include <sstream>

using namespace espalier;
using Catch::Contains;

namespace {

const char* const model_of_stages = R"(environment light;
lsystem: 1
seed: 3
derivation length: 10
axiom: F(1)A(1)
A(x) : x > 0.1 --> F(x)[+(40)A(x*0.7)?light(0.5)]/(137)A(x*0.9) : 2
A(x) : x > 0.1 --> F(x)[-(40)A(x*0.8)~l(0.1)]/(90)A(x*0.85)?light(0) : 1
F(x) : x < 2 --> F(x*1.01)
endlsystem
)";

const char* const stages = R"(
[[plant.stage]]
stage = "stem"
length = 1.5
[[plant.stage]]
stage = "droop"
lambda = 0.5
[[plant.stage]]
stage = "pipe-radii"
tip = 0.004
[[plant.stage]]
stage = "smooth"
pieces = 3
[[plant.stage]]
stage = "leaves"
per_node = 1.5
thickest = 0.01
)";

class Staged {
public:
    Staged() { folder_.write("plant.l", model_of_stages); }

    Scene scene(const std::string& plant) const {
        return read_scene_text("[[plant]]\nmodel = 'plant.l'\npositions = [[0, 0, 0], [1, 0, 0]]\n" + plant +
                                   "[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.25\n",
                               "scene.toml", folder_.path());
    }
    std::filesystem::path output(const std::string& name) const { return folder_.path() / name; }

private:
    TemporaryFolder folder_;
};

bool same(const PlantGeometry& a, const PlantGeometry& b) {
    const auto same_bytes = [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    if (a.organs.size() != b.organs.size()) return false;
    for (std::size_t i = 0; i < a.organs.size(); ++i) {
        if (a.organs[i].pose.position != b.organs[i].pose.position || a.organs[i].size != b.organs[i].size)
            return false;
    }
    return same_bytes(a.internodes, b.internodes);
}

const PlantGeometry& recorded(const World& world, std::size_t plant) {
    return world.frame().plants[plant].interpretation->geometry;
}

}  // namespace

TEST_CASE_METHOD(Staged, "recorders see the stages' geometry, the turtle's queries and World do not", "[simulation]") {
    World plain(scene("")), staged(scene(stages));
    plain.start();
    staged.start();
    for (int step = 0; step < 10; ++step) {
        plain.step();
        staged.step();
        for (std::size_t plant = 0; plant < 2; ++plant) {
            const ModuleString &a = plain.string(plant), &b = staged.string(plant);
            REQUIRE(to_text(a, plain.model(plant).alphabet) == to_text(b, staged.model(plant).alphabet));
            REQUIRE(a.parameters == b.parameters);
            REQUIRE(same(staged.interpretation(plant).geometry, plain.interpretation(plant).geometry));
            REQUIRE(same(recorded(plain, plant), plain.interpretation(plant).geometry));
            REQUIRE_FALSE(same(recorded(staged, plant), plain.interpretation(plant).geometry));
        }
    }
    const PlantGeometry &drawn = staged.interpretation(1).geometry, &seen = recorded(staged, 1);
    CHECK(seen.internodes.size() == 3 * (drawn.internodes.size() + 1));
    CHECK(seen.internodes[0].base == drawn.internodes[0].base);
    CHECK(glm::distance(seen.internodes[2].tip, drawn.internodes[0].base) == Approx(1.5));
    CHECK(seen.organs.size() > drawn.organs.size());
}

TEST_CASE("light falls on what stages draw, and answers the modules that bear it", "[simulation][canopy-light]") {
    TemporaryFolder folder;
    folder.write("bare.l",
                 "environment light;\nlsystem: 1\nderivation length: 1\n"
                 "axiom: @v?light(0,0)F(1)?light(0,0)F(1)\nendlsystem\n");
    const auto absorbed = [&](const std::string& process, const std::string& lines) {
        World world(read_scene_text("[[plant]]\nmodel = 'bare.l'\nturtle.line_width = 0\n" + lines +
                                        "[environment.light]\nprocess = '" + process +
                                        "'\nbands.par = { leaf = [0, 0], stem = 0, soil = 0 }\n"
                                        "sky = { par = 1000, diffuse = 1 }\n",
                                    "scene.toml", folder.path()));
        world.start();
        world.step();  // frame 0 spends no light
        std::map<std::string, double> found;
        for (const Quantity& quantity : world.environment().statistics(0)) found[quantity.name] = quantity.value;
        const auto& answers = world.string(0).parameters;
        found["answers"] = answers[1] + answers[4];
        return found;
    };
    for (const std::string process : {"ray-light", "canopy-light"}) {
        CHECK(absorbed(process, "").at("light.leaf_area") == 0);
        auto leafy = absorbed(process, "[[plant.stage]]\nstage = 'leaves'\nper_node = 20\nsize = 0.1\nspread = 0\n");
        CHECK(leafy["light.leaf_area"] == Approx(2 * 20 * 2 * 0.1 * 0.1));
        CHECK(leafy["light.absorbed"] > 0.1 * 0.8 * 86.4);
        CHECK(leafy["answers"] == Approx(leafy["light.absorbed"]));
        auto fruits =
            absorbed(process, "[[plant.stage]]\nstage = 'leaves'\nkind = 'sphere'\nper_node = 20\nsize = 0.1\n");
        CHECK(fruits["light.leaf_area"] == 0);
        CHECK(fruits["answers"] == Approx(fruits["light.absorbed"]));
        CHECK(fruits["light.absorbed"] > 0.1 * 86.4 * 40 * 0.0314);
    }
}

TEST_CASE_METHOD(Staged, "plants with stages go on bit for bit where they were saved", "[simulation]") {
    World through(scene(stages));
    through.start();
    for (int step = 0; step < 6; ++step) through.step();
    std::ostringstream saved;
    WorldCheckpoint(through).save(saved);
    World resumed(scene(stages));
    std::istringstream in(saved.str());
    WorldCheckpoint(resumed).restore(in);
    for (int step = 6; step < 10; ++step) {
        through.step();
        resumed.step();
        for (std::size_t plant = 0; plant < 2; ++plant) CHECK(same(recorded(through, plant), recorded(resumed, plant)));
    }
}

TEST_CASE_METHOD(Staged, "plants with stages are recorded alike by one thread and by two", "[simulation]") {
    for (int threads : {1, 2}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        run(scene(stages), {.output = output(std::to_string(threads))});
    }
    const auto one = recorded_files(output("1")), two = recorded_files(output("2"));
    CHECK(one.size() > 10);
    CHECK((one == two));
}

TEST_CASE_METHOD(Staged, "mistakes in stages are told with their places", "[simulation]") {
    CHECK_THROWS_WITH(scene("[[plant.stage]]\nstage = 'lefes'\n"),
                      Contains("scene.toml:5") && Contains("no geometry stage 'lefes' (did you mean 'leaves'?)"));
    CHECK_THROWS_WITH(scene("[[plant.stage]]\nstage = 'droop'\nlambda = 1\nfron = 2\n"),
                      Contains("scene.toml:7") && Contains("'fron'") && Contains("did you mean 'from'"));
    CHECK_THROWS_WITH(scene("[[plant.stage]]\nlength = 2\n"), Contains("'stage'"));
    CHECK_THROWS_WITH(scene("[[plant.stages]]\nstage = 'droop'\n"), Contains("did you mean 'stage'"));
}
