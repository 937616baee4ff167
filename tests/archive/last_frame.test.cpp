// The last frame in memory is the one that the timeline holds.
#include "espalier/timeline/last_frame.h"

#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/simulation/simulation.h"

#include "archive/equal_columns.h"
#include "catch.h"
#include "temporary_folder.h"

#include <algorithm>

using namespace espalier;

namespace {

// Internodes, a branch, a polygon, round organs, a surface without a view file, a label.
const char* const model = R"(lsystem: 1
derivation length: 3
axiom: !(0.2) A(1, 5)
A(n, m) --> F(n) [ +(40) F(0.5) @O(0.3) ] [ -(40) @o(0.2) ~l { . f . +(120) f . } @L("%d", m) ] A(n + 1, m - 1)
endlsystem
)";

struct GrownTwice {
    TemporaryFolder folder;
    LastFrame last;
    RunResult result;

    explicit GrownTwice(const std::string& timeline)
        : last((folder.write("tree.l", model),
                Settings::read_toml(folder.write("scene.toml", "[[plant]]\nmodel = \"tree.l\"\n" + timeline))
                    .table("timeline"))),
          result(run(read_scene(folder.path() / "scene.toml"), {.output = folder.path() / "run", .recorder = &last})) {}
};

RunOptions recorded_by(LastFrame& last) {
    RunOptions options;
    options.recorder = &last;
    return options;
}

}  // namespace

TEST_CASE("the last frame in memory is the one in the timeline, column by column", "[reading]") {
    const GrownTwice grown("[timeline]\nparameters = { n = \"A.1\", m = \"A.2\" }\n");
    const RecordedRun recorded(grown.folder.path() / "run");
    const FrameGeometry file = recorded.geometry(recorded.frames().back());
    const FrameGeometry& memory = *grown.last.geometry();
    CHECK(grown.last.step() == 3);
    CHECK(file.lines.size() > 3);
    CHECK(file.polygons.size() > 9);
    CHECK(memory.points == file.points);
    CHECK(memory.normals == file.normals);
    CHECK(memory.uvs == file.uvs);
    CHECK(memory.radii == file.radii);
    CHECK(memory.pixels == file.pixels);
    check_equal(memory.vertices, file.vertices);
    check_equal(memory.lines, file.lines);
    check_equal(memory.polygons, file.polygons);
    check_equal(memory.of_points, file.of_points);
    check_equal(memory.of_cells, file.of_cells);
    CHECK(memory.textures == file.textures);
    CHECK(memory.back_colours == file.back_colours);
    CHECK(memory.symbol_names == file.symbol_names);
    CHECK(memory.label_texts == file.label_texts);
    REQUIRE(memory.parameters.size() == 2);
    for (const auto& [name, values] : file.parameters) {
        const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
        const Column<double>& ours = memory.parameters.at(name);
        CHECK(std::equal(values.begin(), values.end(), ours.begin(), ours.end(), same));
    }
}

TEST_CASE("what a process knows of organs is in both, but for directions", "[reading]") {
    const GrownTwice grown(
        "[environment.light]\nprocess = \"ray-light\"\npaths = 256\n"
        "[timeline]\norgans = [\"light.absorbed\", \"light.brightest\"]\n");
    const RecordedRun recorded(grown.folder.path() / "run");
    const FrameGeometry file = recorded.geometry(recorded.frames().back());
    REQUIRE(file.parameters.size() == 1);
    const Column<double>&absorbed = file.parameters.at("light.absorbed"),
          &ours = grown.last.geometry()->parameters.at("light.absorbed");
    const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
    CHECK(std::equal(absorbed.begin(), absorbed.end(), ours.begin(), ours.end(), same));
    CHECK(std::any_of(absorbed.begin(), absorbed.end(), [](double value) { return value > 0; }));
    CHECK(file.units == std::map<std::string, std::string>{{"light.absorbed", "mol"}});
    CHECK(grown.last.geometry()->units == file.units);
}

TEST_CASE("organs of a frame are those of its step, though the world has gone on when it is written", "[reading]") {
    const TemporaryFolder folder;
    folder.write("tree.l", model);
    folder.write("scene.toml",
                 "[[plant]]\nmodel = \"tree.l\"\n[environment.light]\nprocess = \"ray-light\"\npaths = 64\n"
                 "[timeline]\norgans = [\"light.front\"]\n");
    run(read_scene(folder.path() / "scene.toml"), {.output = folder.path() / "run"});
    const RecordedRun recorded(folder.path() / "run");
    for (int steps = 1; steps <= 3; ++steps) {
        const Scene scene = read_scene(folder.path() / "scene.toml", {{}, steps, {}});
        LastFrame last(scene.timeline);
        run(scene, recorded_by(last));
        const Column<double> file = recorded.geometry(recorded.frame(steps)).parameters.at("light.front"),
                             memory = last.geometry()->parameters.at("light.front");
        const auto same = [](double a, double b) { return a == b || (a != a && b != b); };
        CHECK(std::equal(file.begin(), file.end(), memory.begin(), memory.end(), same));
    }
}

TEST_CASE("a run in memory says what its run.json says", "[reading]") {
    const GrownTwice grown("");
    const RecordedRun recorded(grown.folder.path() / "run");
    const RecordedRun memory(grown.result.record,
                             {{grown.last.step(), grown.last.time(), {}, {}, grown.last.geometry()}});
    CHECK(memory.folder().empty());
    CHECK(memory.scene() == recorded.scene());
    CHECK(memory.exit() == "done");
    CHECK(memory.plants().at(0).name == recorded.plants().at(0).name);
    CHECK(memory.frames().at(0).step == recorded.frames().back().step);
    CHECK(memory.geometry(memory.frames()[0]).points == grown.last.geometry()->points);
    CHECK_THROWS_AS(RecordedRun("{}", {}), UserError);
}

TEST_CASE("a run without a folder has a last frame, and one that stops has that", "[reading]") {
    TemporaryFolder folder;
    folder.write("a.l",
                 "lsystem: 1\nderivation length: 9\naxiom: A(1)\nA(n) : n == 4 {stop(1);} --> F\nA(n) --> F A(n + 1)\n"
                 "endlsystem\n");
    folder.write("scene.toml", "[[plant]]\nmodel = \"a.l\"\n");
    LastFrame last;
    const RunResult result = run(read_scene(folder.path() / "scene.toml"), recorded_by(last));
    CHECK(result.stopped);
    REQUIRE(last.geometry());
    CHECK(last.step() == 4);
    CHECK(internodes_of(*last.geometry()).size() == 4);
    CHECK_THROWS_AS(LastFrame(Settings::read_toml(folder.write("t.toml", "parameters = { x = \"A\" }\n"))), UserError);
}
