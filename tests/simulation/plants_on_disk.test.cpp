// Worlds of which only some plants are in memory: the bytes of one that is there as a whole.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world_checkpoint.h"

#include "catch.h"
#include "simulation/shading_stand.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

using namespace espalier;
using namespace espalier::simulation;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// Turtles answer, too, and the module that follows a query matters to the process.
const char* const pruned =
    "environment light;\nlsystem: 1\nderivation length: 7\naxiom: A\n"
    "A --> F(1)?P(0,0,0)?light(1)P(2)[+A]/(137)A\n"
    "?P(x,y,z) : y > 3 --> @O(x*x)\n?light(q) > P(s) : q < 0.9 --> F(q*s)\nendlsystem\n";

class Stored : public TemporaryFolder {
public:
    Stored() {
        write("shading.l", shading);
        write("pruned.l", pruned);
    }

    Scene scene(const std::string& rest) const {
        return read_scene_text(
            "[simulation]\nseed = 11\n"
            "[[plant]]\nmodel = 'shading.l'\ngrid = { columns = 4, rows = 3, spacing = 2, jitter = 1 }\n"
            "[[plant]]\nmodel = 'pruned.l'\ngrid = { columns = 2, rows = 2, spacing = 3 }\nposition = [1, 0, 1]\n" +
                rest,
            "scene.toml", path());
    }

    void run_with(const Scene& scene, const std::string& folder, std::size_t blocks, std::size_t resident = 1,
                  const std::function<void(RunOptions&)>& change = {}) const {
        RunOptions options;
        options.output = path() / folder;
        options.overwrite = true;
        options.blocks = blocks;
        options.resident = resident;
        if (change) change(options);
        run(scene, options);
    }

    void check_same(const std::string& folder) const { check_same_files(path() / "whole", path() / folder); }
};

}  // namespace

TEST_CASE_METHOD(Stored, "a world has the same bytes however many of its plants are in memory", "[simulation][store]") {
    const std::string rest =
        GENERATE(std::string(light), std::string(light) + "[timeline]\nfields = ['light']\npoints_per_file = 100\n",
                 std::string("[environment.light]\nprocess = 'density'\n"),
                 std::string("[[plant.stage]]\nstage = 'pipe-radii'\n[[plant.stage]]\nstage = 'leaves'\n") + light);
    INFO(rest);
    const Scene described = scene(rest);
    run_with(described, "whole", 0);
    for (const auto& [blocks, resident] : {std::pair(1, 1), std::pair(3, 1), std::pair(16, 3), std::pair(100, 1)}) {
        INFO(blocks << " blocks, " << resident << " in memory");
        const std::string folder = fmt::format("stored-{}-{}", blocks, resident);
        run_with(described, folder, static_cast<std::size_t>(blocks), static_cast<std::size_t>(resident));
        check_same(folder);
    }
}

TEST_CASE_METHOD(Stored, "numbers of single precision wait as they are", "[simulation][store]") {
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'shading.l'\narithmetic = 'cpfg'\ngrid = { columns = 4, rows = 3, spacing = 2 }\n" +
            std::string(light),
        "scene.toml", path());
    run_with(described, "whole", 0);
    run_with(described, "stored", 5);
    check_same("stored");
}

TEST_CASE_METHOD(Stored, "a run goes on from its checkpoint with other plants in memory", "[simulation][store]") {
    const Scene described = scene(light);
    run_with(described, "whole", 0);
    const auto fail_at_the_sixth_step = [](RunOptions& options) {
        options.checkpoint_every = 2;
        options.progress = [](const Progress& progress) {
            if (progress.step == 5) throw RunError("the machine is gone");
        };
    };
    const auto go_on = [](RunOptions& options) {
        options.overwrite = false;
        options.resume = true;
    };
    for (const auto& [before, after] : {std::pair(4, 7), std::pair(0, 3), std::pair(3, 0)}) {
        INFO(before << " blocks, then " << after);
        const std::string folder = fmt::format("again-{}-{}", before, after);
        CHECK_THROWS_WITH(run_with(described, folder, static_cast<std::size_t>(before), 1, fail_at_the_sixth_step),
                          Contains("the machine is gone"));
        run_with(described, folder, static_cast<std::size_t>(after), 1, go_on);
        check_same(folder);
    }
}

TEST_CASE_METHOD(Stored, "what fails names the plant, and leaves no file of plants that wait", "[simulation][store]") {
    write("falling.l", "lsystem: 1\nderivation length: 9\naxiom: A(4)\nA(x) --> F(1/x)A(x-1)\nendlsystem\n");
    const Scene described = read_scene_text(
        "[[plant]]\nmodel = 'shading.l'\nposition = [9, 0, 0]\n[[plant]]\nmodel = 'falling.l'\nname = 'weak'\n" +
            std::string(light),
        "scene.toml", path());
    CHECK_THROWS_WITH(run_with(described, "failed", 2), Contains("weak"));
    for (const auto& item : fs::directory_iterator(path() / "failed")) {
        CHECK_THAT(item.path().filename().string(), !Contains("waiting"));
    }
}

TEST_CASE_METHOD(Stored, "processes that read whole plants are refused", "[simulation][store]") {
    const Scene described = scene("[environment.light]\nprocess = 'ray-light'\n");
    CHECK_THROWS_WITH(run_with(described, "refused", 2), Contains("'light' reads whole plants"));
    CHECK_FALSE(fs::exists(path() / "refused"));
}

TEST_CASE_METHOD(Stored, "the last frame has its plants wherever a run ends", "[simulation][store]") {
    const std::string last = "[timeline]\nevery = 100\nlifespans = false\nstatistics = false\n";
    SECTION("at its derivation length") {
        const Scene described = scene(std::string(light) + last);
        run_with(described, "whole", 0);
        run_with(described, "stored", 5);
        CHECK(recorded_files(path() / "stored").contains("plants/0009.vtp"));
    }
    SECTION("where the last of its models calls stop()") {
        write("stopping.l",
              "environment light;\nlsystem: 1\nderivation length: 9\naxiom: A(5)\n"
              "A(n) : n == 0 { stop(1); } --> F\nA(n) --> F?light(1)[+A(n)]A(n-1)\nendlsystem\n");
        const Scene described = read_scene_text(
            "[[plant]]\nmodel = 'shading.l'\ngrid = { columns = 4, rows = 3, spacing = 2 }\n"
            "[[plant]]\nmodel = 'stopping.l'\nposition = [3, 0, 1]\n" +
                std::string(light) + last,
            "scene.toml", path());
        run_with(described, "whole", 0);
        run_with(described, "stored", 5);
        CHECK(recorded_files(path() / "stored").contains("plants/0006.vtp"));
    }
    const auto expected = recorded_files(path() / "whole"), recorded = recorded_files(path() / "stored");
    CHECK(recorded == expected);
}

TEST_CASE_METHOD(Stored, "what is drawn of plants waits only for recorders that will read it", "[simulation][store]") {
    class AtEvenSteps : public Recorder {
    public:
        bool reads_plants_at(int step, bool) const override { return step % 2 == 0; }
        void record(const Frame& frame) override {
            for (const PlantFrame& plant : frame.plants) drawn += plant.interpretation->geometry.internodes.size();
        }
        void finish() override {}

        std::size_t drawn = 0;
    };
    const Scene described = scene(light);
    World world(described, {.blocks = BlocksOnDisk{path(), 6}});
    const WorldCheckpoint checkpoint(world);
    AtEvenSteps recorder;
    world.attach(recorder);
    world.start();
    std::size_t waiting = checkpoint.bytes();
    for (int step = 1; step <= 8; ++step) {
        recorder.drawn = 0;
        world.step();
        INFO("step " << step);
        CHECK((recorder.drawn > 0) == (step % 2 == 0));
        if (step % 2 == 0) CHECK(checkpoint.bytes() > 2 * waiting);
        waiting = checkpoint.bytes();
    }
}

TEST_CASE_METHOD(Stored, "less memory suffices where plants wait on disk", "[simulation][store]") {
    write("doubling.l", doubling);
    const Scene described = read_scene_text(doubling_stand, "scene.toml", path());
    const auto with_little = [](RunOptions& options) { options.memory = std::size_t{100} << 20; };
    CHECK_THROWS_WITH(run_with(described, "whole", 0, 1, with_little), Contains("--memory"));
    run_with(described, "stored", 16, 1, with_little);
    CHECK(recorded_files(path() / "stored").contains("plants/0015.vtp"));
}
