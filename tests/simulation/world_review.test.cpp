// What a world finds odd about its scene: processes that nothing asks, models of which nothing is drawn.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "simulation/thread_ranks.h"
#include "temporary_folder.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace espalier;
using Catch::Contains;

namespace {

class Scenes {
public:
    Scenes() {
        folder_.write("ask.l",
                      "environment light;\nlsystem: 1\nderivation length: 2\naxiom: FA?light(1)\n"
                      "A ?light(q) : q > 0 --> FA?light(1)\nendlsystem\n");
        folder_.write("mute.l", "lsystem: 1\nderivation length: 2\naxiom: FA\nA --> FA\nendlsystem\n");
        folder_.write("bare.l", "lsystem: 1\nderivation length: 3\naxiom: A\nA --> AB\nendlsystem\n");
    }

    Scene scene(const std::string& text) const { return read_scene_text(text, "scene.toml", folder_.path()); }
    const std::filesystem::path& path() const { return folder_.path(); }
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }

    /// What is told of a whole run, one warning a line.
    std::string told(const std::string& text, bool only_insistent = false, std::optional<int> steps = {}) const {
        RunOptions options;
        options.output = folder_.path() / "run";
        options.overwrite = true;
        std::string all;
        options.warn = [&](const std::vector<Diagnostic>& warnings) {
            for (const Diagnostic& each : warnings) {
                if (each.insistent || !only_insistent) all += each.message + "\n";
            }
        };
        run(read_scene_text(text, "scene.toml", folder_.path(), {{}, steps, {}}), options);
        return all;
    }

private:
    TemporaryFolder folder_;
};

std::string plant(const std::string& model) {
    return "[[plant]]\nmodel = '" + model + "'\n";
}

const char* const shade = "[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.5\n";
const char* const pot =
    "[environment.pot]\nprocess = 'shape'\nshape = 'sphere'\ncenter = [0, 0, 0]\nradius = 9\nvoxel = 1\n";

}  // namespace

TEST_CASE_METHOD(Scenes, "a process that no plant asks is told before anything grows", "[simulation]") {
    const World world(scene(plant("mute.l") + shade));
    REQUIRE(world.warnings().size() == 1);
    const Diagnostic& warning = world.warnings()[0];
    CHECK(warning.message ==
          "no plant asks the process 'light', and nothing reads or records its fields: a model asks it "
          "by ?light(...), after 'environment light;'");
    CHECK(warning.place.line == 3);
    CHECK(!warning.insistent);
    CHECK(World(scene(plant("ask.l") + shade)).warnings().empty());
    // One plant that asks is enough.
    CHECK(World(scene(plant("mute.l") + plant("ask.l") + shade)).warnings().empty());
}

TEST_CASE_METHOD(Scenes, "a process is there for those that record, read or name it, too", "[simulation]") {
    CHECK(World(scene(plant("ask.l") + shade + pot)).warnings().size() == 1);
    for (const char* rest : {"[timeline]\nfields = ['light', 'pot.distance']\n", "[timeline]\nfields = ['all']\n"}) {
        CHECK(World(scene(plant("ask.l") + shade + pot + rest)).warnings().empty());
    }
    // A light that measures leaves.
    CHECK(World(scene(plant("mute.l") + "[environment.light]\nprocess = 'canopy-light'\nvoxel = 0.5\n"))
              .warnings()
              .empty());
    // ?E asks the only process, and models read fields.
    write("any.l", "lsystem: 1\nderivation length: 1\naxiom: F?E(1)\nendlsystem\n");
    CHECK(World(scene(plant("any.l") + shade)).warnings().empty());
    write("field.l",
          "field sun = gradient(light);\nlsystem: 1\nderivation length: 1\naxiom: @Tv(sun, 1)F\nF --> F\nendlsystem\n");
    CHECK(World(scene(plant("field.l") + shade)).warnings().empty());
}

TEST_CASE_METHOD(Scenes, "a process that could be asked and never was is told in the end", "[simulation]") {
    write("late.l",
          "environment light;\nlsystem: 1\nderivation length: 3\naxiom: FA(0)\nA(n) : n == 2 --> A(3)?light(1)\n"
          "A(n) : n < 2 --> FA(n+1)\nendlsystem\n");
    CHECK(told(plant("late.l") + shade) == "");
    CHECK(told("[simulation]\nsteps = 2\n" + plant("late.l") + shade) ==
          "in 2 steps no plant has asked the process 'light'\n");
    CHECK(told("[simulation]\nsteps = 2\n" + plant("late.l") + shade, /*only_insistent=*/true) == "");
    // Who asks for fewer steps than the model has looks at the first.
    CHECK(told(plant("late.l") + shade, false, 2) == "");
}

TEST_CASE_METHOD(Scenes, "a model of which nothing was drawn in a whole run is told, also under --quiet",
                 "[simulation]") {
    CHECK(told(plant("bare.l"), true) ==
          "nothing was drawn of this model in 3 steps, and it asked no process: its string never held an F or another "
          "symbol that the turtle draws\n");
    CHECK(told(plant("mute.l")) == "");
    write("still.l", "lsystem: 1\naxiom: A\nA --> F\nendlsystem\n");
    CHECK(told(plant("still.l"), true) ==
          "nothing is drawn of this model: the run has no steps. Is 'derivation length' missing?\n");
    CHECK(told(plant("still.l"), true, 0) == "");
    CHECK(told(plant("bare.l"), true, 2) == "");
    CHECK(told(plant("bare.l"), true, 7) != "");
    // Who was there once was there, and of a stand one is enough.
    write("dies.l", "lsystem: 1\nderivation length: 3\naxiom: FA\nF --> *\nendlsystem\n");
    CHECK(told(plant("dies.l")) == "");
    write("chance.l",
          "#define SOWN 0\nlsystem: 1\nderivation length: 2\naxiom: A(SOWN)\nA(n) : n > 0 --> F\nendlsystem\n");
    CHECK(told(plant("chance.l") + "positions = [[0, 0, 0], [1, 0, 0]]\n") != "");
    write("sensor.l", "lsystem: 1\nderivation length: 2\naxiom: f(1)?E(1)\nendlsystem\n");
    CHECK(told(plant("sensor.l") + shade) == "");
    write("leaf.l",
          "lsystem: 1\nderivation length: 2\naxiom: A\nA --> A\nhomomorphism\nA --> {.f.+(90)f.}\nendlsystem\n");
    CHECK(told(plant("leaf.l")) == "");
}

TEST_CASE_METHOD(Scenes, "an up vector that is not perpendicular, and a tropism that there is not, are told once",
                 "[simulation]") {
    const auto of = [&](const std::string& axiom) {
        write("turns.l", "lsystem: 1\nderivation length: 3\naxiom: " + axiom + "F\nF --> F F\nendlsystem\n");
        return told(
            plant("turns.l") + "positions = [[0, 0, 0], [1, 0, 0]]\nturtle = { tropism = [{ elasticity = 0.1 }] }\n",
            true);
    };
    const std::string up =
        "@R is given an up vector that is not perpendicular to its heading, within 1e-9, or not whole: it "
        "has no effect, and the turtle twists least\n";
    CHECK(of("@R(1,0,0,0.1,1,0)") == up);
    CHECK(of("@R(1,0,0,1e-8,1,0)") == up);
    CHECK(of("@R(1,0,0,0,1)") == up);
    CHECK(of("@R(1,0,0,0,1,0)") == "");
    CHECK(of("@R(1,0,0,1e-10,1,0)") == "");
    CHECK(of("@R(1,0,0)@R(1,0,0,0,0,0)") == "");
    CHECK_THAT(of("@Ts(2,0.3)"), Contains("names a tropism that there is not"));
    CHECK(of("@Ts(1,0.3)@Ti(1,0.1)") == "");
}

TEST_CASE_METHOD(Scenes, "ranks know together what was drawn and asked", "[simulation]") {
    write("up.l", "lsystem: 1\nderivation length: 2\naxiom: @R(1,0,0,1,1,0)F\nF --> F\nendlsystem\n");
    std::string text = "[simulation]\nblocks = [4, 1]\n";
    int x = 0;
    for (const char* model : {"bare.l", "mute.l", "ask.l", "up.l"}) {
        text += plant(model) + "position = [" + std::to_string(x) + ", 0, 0]\n";
        x += 10;
    }
    const Scene described = scene(text + shade);
    const auto errors = on_ranks(4, [&](Ranks& ranks) {
        World world(described, {.ranks = &ranks});
        world.start();
        while (!world.at_end()) world.step();
        world.review_run();
        if (ranks.rank() != 0) return;
        std::string told;
        for (const Diagnostic& each : world.warnings()) {
            if (each.insistent) told += std::filesystem::path(each.place.file).filename().string() + "\n";
        }
        if (told != "up.l\nbare.l\n") throw std::runtime_error(told);
    });
    for (const std::string& error : errors) CHECK(error == "");
}

TEST_CASE_METHOD(Scenes, "what only a whole run shows is not told of a run that goes on from a checkpoint",
                 "[simulation]") {
    const Scene described = scene(plant("bare.l"));
    World first(described);
    first.start();
    first.step();
    std::stringstream saved;
    WorldCheckpoint(first).save(saved);
    World second(described);
    WorldCheckpoint(second).restore(saved);
    while (!second.at_end()) second.step();
    second.review_run();
    CHECK(second.warnings().empty());
    while (!first.at_end()) first.step();
    first.review_run();
    CHECK(first.warnings().size() == 1);
}

TEST_CASE_METHOD(Scenes, "models are reviewed when a scene is read, each once", "[simulation]") {
    write("open.l", "lsystem: 1\nderivation length: 1\naxiom: F[F\nF --> F\nendlsystem\n");
    const Scene twice = scene(plant("open.l") + plant("open.l") + "define = {}\n");
    const auto count =
        std::count_if(twice.notes.diagnostics.begin(), twice.notes.diagnostics.end(), [](const auto& note) {
            return note.insistent && note.message == "this branch is not closed in this axiom: ']' is missing";
        });
    CHECK(count == 1);
    // What the scene inserts is produced.
    write("mouse.l", "lsystem: 1\nderivation length: 1\naxiom: F\nX --> F\nendlsystem\n");
    CHECK(scene(plant("mouse.l")).notes.diagnostics.size() == 1);
    CHECK(scene(plant("mouse.l") + "insert = ['X@1']\n").notes.diagnostics.empty());
}
