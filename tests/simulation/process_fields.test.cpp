// Plants whose turtles read what the processes of their world published.
#include "espalier/geometry/openvdb_grid.h"
#include "espalier/simulation/world.h"

#include "catch.h"
#include "resumed_world.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <openvdb/io/File.h>

using namespace espalier;
using Catch::Contains;

namespace {

const char* const seeker = R"(pgraph 1
#define PULL 0.5
World lit
  light gradient(light)
Tree stem
  length 3
  pieces 60
  phototropism PULL
camera -> lit -> stem
)";

const char* const roof = "environment light;\nlsystem: 1\naxiom: ?light(1)\n?light(x) --> ?light(1)\nendlsystem\n";

const char* const two = R"([simulation]
steps = 6
[[plant]]
model = 'seeker.pgraph'
[[plant]]
model = 'roof.l'
position = [-1.25, 3, 0]
grid = { columns = 6, rows = 8, spacing = 0.5 }
[environment.light]
process = 'voxel-shade'
voxel = 0.5
strength = 0.05
dissipation = 1.1
depth = 8
)";

class Lit {
public:
    Lit() {
        folder_.write("seeker.pgraph", seeker);
        folder_.write("roof.l", roof);
    }
    Scene scene(std::string text = two, const std::string& from = "", const std::string& to = "") const {
        if (!from.empty()) text.replace(text.find(from), from.size(), to);
        return read_scene_text(text, "scene.toml", folder_.path());
    }
    const std::filesystem::path& folder() const { return folder_.path(); }
    static glm::dvec3 tip(const World& world) { return world.interpretation(0).geometry.internodes.back().tip; }
    /// Returns the tip of the stem after all steps.
    static glm::dvec3 tip(const Scene& scene) {
        World world(scene);
        world.start();
        while (world.steps_done() < world.last_step()) world.step();
        return tip(world);
    }

private:
    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE_METHOD(Lit, "a stem in the gradient of a process's light bends away from the shade", "[simulation]") {
    const glm::dvec3 beside = tip(scene());
    CHECK(beside.x > 0.3);
    CHECK(beside.y > 2);
    const glm::dvec3 mirrored = tip(scene(two, "[-1.25, 3, 0]", "[1.25, 3, 0]"));
    CHECK(mirrored.x == Approx(-beside.x).epsilon(0.02));
    const glm::dvec3 shunning = tip(scene(two, "'seeker.pgraph'", "'seeker.pgraph'\ndefine = { PULL = -0.5 }"));
    CHECK(shunning.x < -0.3);
    CHECK(glm::length(tip(scene(two, "strength = 0.05", "strength = 0")) - glm::dvec3(0, 3, 0)) < 1e-9);
}

TEST_CASE_METHOD(Lit, "a turtle reads the field that its process left after the step before", "[simulation]") {
    // The roof is there from step 3 on.
    const TemporaryFolder folder;
    folder.write("seeker.pgraph", seeker);
    folder.write("roof.l",
                 "environment light;\nlsystem: 1\naxiom: A(1)\nA(k) : k < 3 --> A(k + 1)\nA(k) --> ?light(1)\n"
                 "?light(x) --> ?light(1)\nendlsystem\n");
    World world(read_scene_text(two, "scene.toml", folder.path()));
    world.start();
    world.step();
    world.step();
    CHECK(glm::length(tip(world) - glm::dvec3(0, 3, 0)) < 1e-9);
    world.step();
    CHECK(glm::length(tip(world) - glm::dvec3(0, 3, 0)) < 1e-9);
    world.step();
    const glm::dvec3 bent = tip(world);
    CHECK(bent.x > 0.3);
    world.step();
    CHECK(tip(world) == bent);  // the same shadows as before
}

TEST_CASE_METHOD(Lit, "a world that reads fields goes on from its checkpoint as if it had not stopped",
                 "[simulation]") {
    // A roof that grows, so that every step reads another field.
    const std::string growing =
        "environment light;\nlsystem: 1\nderivation length: 6\naxiom: A\nA --> ?light(1)f(0.5)A\nendlsystem\n";
    const TemporaryFolder folder;
    folder.write("seeker.pgraph", seeker);
    folder.write("roof.l", growing);
    const Scene described = read_scene_text(two, "scene.toml", folder.path());
    simulation_test::ResumedWorld worlds(described, 3);
    const glm::dvec3 before = tip(worlds.through);
    for (int step = 3; step < 6; ++step) {
        worlds.step();
        CHECK(tip(worlds.through) == tip(worlds.resumed));
    }
    CHECK(tip(worlds.through) != before);
}

TEST_CASE_METHOD(Lit, "a field that no process has is told before the first step, with the nearest name",
                 "[simulation]") {
    const auto refusal = [&](const std::string& process) {
        std::string text = two;
        text.replace(text.find("[environment.light]"), 19, "[environment." + process + "]");
        text.replace(text.find("'roof.l'"), 8, "'seeker.pgraph'\nname = 'other'");
        try {
            World world(read_scene_text(text, "scene.toml", folder()));
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refusal("lights"),
               Contains("model seeker.pgraph reads the field 'light', which no process of the scene has (did you mean "
                        "'lights'?); there are: lights, lights.shade"));
}

TEST_CASE_METHOD(Lit, "a stem follows maps that change in time, and goes on from a checkpoint as it went through",
                 "[simulation]") {
    initialize_openvdb();
    for (const int map : {0, 1}) {
        const auto grid = openvdb::FloatGrid::create();
        grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
        const openvdb::CoordBBox box(openvdb::Coord(-8), openvdb::Coord(8));
        for (auto at = box.beginZYX(); at; ++at) {
            grid->tree().setValue(*at, float((map == 0 ? 1 : -1) * grid->indexToWorld(*at).x()));
        }
        openvdb::io::File file((folder() / ("map" + std::to_string(map) + ".vdb")).string());
        file.write({grid});
        file.close();
    }
    const Scene changing = read_scene_text(
        "[simulation]\nsteps = 6\n[[plant]]\nmodel = 'seeker.pgraph'\n"
        "[environment.light]\nprocess = 'vdb'\nmaps = [{ time = 0, file = "
        "'map0.vdb' }, { time = 6, file = 'map1.vdb' }]\n",
        "scene.toml", folder());
    simulation_test::ResumedWorld both(changing, 2);
    CHECK(tip(both.through).x > 0.3);
    for (int step = 2; step < 6; ++step) {
        both.step();
        CHECK(tip(both.through) == tip(both.resumed));
    }
    CHECK(tip(both.through).x < -0.1);  // the light of step 5 fell from the other side
}
