#include "espalier/simulation/simulation.h"

#include "espalier/base/stop.h"

#include "catch.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <chrono>
#include <map>
#include <thread>

using namespace espalier;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

// Shoots ask for light; roots ask whether they are in the pot and how much water they get.
const char* const bush = R"(environment light, water, pot;
lsystem: 1
seed: 3
derivation length: 6
axiom: [?light(1)A][|?pot(0)?water(0.2,1,1,0)R]
?light(q) < A : q > 0 --> F(0.5)[+(35)/(90)?light(1)A]?light(1)A : 2
?light(q) < A : q > 0 --> F(0.7)/(137)?light(1)A : 1
?light(q) --> ?light(1)
?pot(inside) ?water(w,x,y,z) < R : inside && w > 0 --> F(0.2)[+(30)?pot(0)?water(0.2,1,1,0)R]\(60)?pot(0)?water(0.2,1,1,0)R
endlsystem
)";

const char* const two_bushes = R"(
[simulation]
seed = 5
domain = { lower = [-2, -2, -2], upper = [3, 4, 2] }
[[plant]]
model = 'bush.l'
positions = [[0, 0, 0], [1, 0, 0]]
[environment.light]
process = 'voxel-shade'
voxel = 0.25
[environment.pot]
process = 'shape'
shape = 'sphere'
center = [0.5, 0, 0]
radius = 1.5
voxel = 0.1
[environment.water]
process = 'soil-water'
voxel = 0.25
initial = 0.5
diffusion = 0.01
[timeline]
fields = ['light', 'water']
)";

class Runs {
public:
    Runs() { folder_.write("bush.l", bush); }

    Scene scene(const std::string& text = two_bushes) const {
        return read_scene_text(text, "scene.toml", folder_.path());
    }
    Scene scene_with_model(const std::string& model) const {
        folder_.write("plant.l", model);
        return scene("[[plant]]\nmodel = 'plant.l'\n");
    }
    fs::path output(const std::string& name) const { return folder_.path() / name; }

private:
    TemporaryFolder folder_;
};

std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
    }
    return files;
}

nlohmann::json record_of(const fs::path& folder) {
    return nlohmann::json::parse(text_of(folder / "run.json"));
}

std::size_t frames_in(const fs::path& folder) {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder / "plants")) count += entry.path().extension() == ".vtp";
    return count;
}

}  // namespace

TEST_CASE_METHOD(Runs, "one thread and two write the same bytes", "[simulation]") {
    for (int threads : {1, 2}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        run(scene(), {.output = output(std::to_string(threads))});
    }
    std::map<std::string, std::string> one = files_of(output("1")), two = files_of(output("2"));
    for (const char* timed : {"run.json", "timings.csv"}) {
        CHECK(one.erase(timed) == 1);
        CHECK(two.erase(timed) == 1);
    }
    CHECK(one.size() > 30);
    REQUIRE(one.size() == two.size());
    for (const auto& [name, bytes] : one) {
        INFO(name);
        CHECK((two.count(name) == 1 && bytes == two[name]));
    }
}

TEST_CASE_METHOD(Runs, "a run records what it takes to repeat it", "[simulation]") {
    const RunResult result = run(scene(), {.output = output("run")});
    CHECK(result.steps == 6);
    CHECK_FALSE(result.interrupted);
    const nlohmann::json record = record_of(output("run"));
    CHECK(record["exit"] == "done");
    CHECK(record["steps_done"] == 6);
    CHECK(record["seed"] == 5);
    CHECK(record["version"] == ESPALIER_VERSION);
    CHECK(record["scene"]["text"] == two_bushes);
    CHECK(record["parameters"]["environment"]["light"]["voxel"] == 0.25);
    CHECK(record["parameters"]["simulation"]["steps"] == 6);
    CHECK(record["plants"].size() == 2);
    CHECK(frames_in(output("run")) == 7);
    const std::string timings = text_of(output("run") / "timings.csv");
    CHECK(std::count(timings.begin(), timings.end(), '\n') == 8);
}

TEST_CASE_METHOD(Runs, "a run records the most memory it ever held, which never falls", "[simulation]") {
    const std::size_t before = peak_memory();
    std::vector<char> ballast(before + (std::size_t(64) << 20), 'x');
    CHECK(ballast.back() == 'x');
    const std::size_t held = peak_memory();
    CHECK(held > before + (std::size_t(32) << 20));
    const RunResult result = run(scene(), {.output = output("run"), .memory = std::size_t(1) << 30});
    const nlohmann::json record = record_of(output("run"));
    CHECK(record["memory"] == std::size_t(1) << 30);
    CHECK(record["peak_memory"] >= held);
    CHECK(result.peak_memory >= record["peak_memory"].get<std::size_t>());
}

TEST_CASE_METHOD(Runs, "a run that has recorded nothing yet has done no steps, and not minus one", "[simulation]") {
    nlohmann::json record;
    const auto look = [&](const Progress& progress) {
        if (progress.step == 0) record = record_of(output("run"));
    };
    run(scene(), {.output = output("run"), .progress = look});
    CHECK(record["exit"] == "running");
    CHECK(record["steps_done"] == 0);
}

TEST_CASE_METHOD(Runs, "an interrupted run keeps every frame so far and says so", "[simulation]") {
    StopRequest interrupt;
    const StopRequest::Scope scope(&interrupt);
    RunOptions options;
    options.output = output("run");
    options.progress = [&](const Progress& progress) {
        if (progress.step == 3) interrupt.ask();
    };
    const RunResult result = run(scene(), options);
    CHECK(result.interrupted);
    CHECK(result.steps == 3);
    CHECK(record_of(output("run"))["exit"] == "interrupted");
    CHECK(record_of(output("run"))["steps_done"] == 3);
    CHECK(frames_in(output("run")) == 4);
    CHECK_THAT(text_of(output("run") / "plants.pvd"), Contains("0003.vtp") && Contains("</VTKFile>"));
}

TEST_CASE_METHOD(Runs, "a run of quick steps writes checkpoints by itself, too", "[simulation]") {
    const Scene quick =
        scene_with_model("lsystem: 1\nderivation length: 100000\naxiom: F(1)\nF(x) --> F(x+1)\nendlsystem\n");
    StopRequest interrupt;
    const StopRequest::Scope scope(&interrupt);
    std::optional<int> step;
    RunOptions options{.output = output("run"), .checkpoint_seconds = 0};
    options.progress = [&](const Progress&) {
        if (!step) step = step_of_checkpoint(output("run"));
        if (step) interrupt.ask();
    };
    const RunResult result = run(quick, options);
    REQUIRE(step);
    CHECK(*step >= 1);
    CHECK(*step < result.steps);
    CHECK(step_of_checkpoint(output("run")) == result.steps);
    CHECK_FALSE(step_of_checkpoint(output("elsewhere")));
    std::ofstream(output("run") / "checkpoint") << "no such thing";
    CHECK_FALSE(step_of_checkpoint(output("run")));
}

TEST_CASE_METHOD(Runs, "an interrupt during the last step interrupts nothing", "[simulation]") {
    StopRequest interrupt;
    const StopRequest::Scope scope(&interrupt);
    RunOptions options;
    options.progress = [&](const Progress& progress) {
        if (progress.step == 6) interrupt.ask();
    };
    CHECK_FALSE(run(scene(), options).interrupted);
}

TEST_CASE_METHOD(Runs, "a run that is asked to end in the midst of a step drops it", "[simulation][stop]") {
    const Scene endless =
        scene_with_model("lsystem: 1\nderivation length: 5\naxiom: " + std::string(500, 'F') +
                         "\nF : {i = 0; while (Q > 2 && i < 9e7) {i = i + 1;}} 1 --> F F\nendlsystem\n");
    StopRequest interrupt;
    const StopRequest::Scope scope(&interrupt);
    std::jthread asking;
    RunOptions options{.output = output("run")};
    options.progress = [&](const Progress& progress) {
        if (progress.step != 2) return;
        asking = std::jthread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            interrupt.ask(std::chrono::milliseconds(1));
        });
    };
    const RunResult result = run(endless, options);
    CHECK(result.interrupted);
    CHECK(result.steps == 2);
    CHECK(result.seconds < 10);
    CHECK(record_of(output("run"))["exit"] == "interrupted");
    CHECK(record_of(output("run"))["steps_done"] == 2);
    CHECK(frames_in(output("run")) == 3);
}

TEST_CASE_METHOD(Runs, "a failure in step k leaves frames 0 to k-1 whole, and the reason", "[simulation]") {
    const Scene failing = scene_with_model(
        "lsystem: 1\nderivation length: 5\naxiom: A(0)\nA(n) --> F(1 + 0 * (1 / (2 - n)))A(n + 1)\nendlsystem\n");
    CHECK_THROWS_AS(run(failing, {.output = output("run")}), RunError);
    const nlohmann::json record = record_of(output("run"));
    CHECK_THAT(record["exit"].get<std::string>(), Contains("failed: ") && Contains("plant.l:4"));
    CHECK(record["steps_done"] == 2);
    CHECK(frames_in(output("run")) == 3);
    CHECK_THAT(text_of(output("run") / "plants.pvd"), Contains("0002.vtp") && !Contains("0003.vtp"));
}

TEST_CASE_METHOD(Runs, "a model that stops is done before its steps are", "[simulation]") {
    const Scene stopping = scene_with_model(
        "lsystem: 1\nStartEach: { if (Q == 2) { stop(0); } }\nderivation length: 9\naxiom: F\nF --> FF\nendlsystem\n");
    const RunResult result = run(stopping, {.output = output("run")});
    CHECK(result.stopped);
    CHECK_FALSE(result.interrupted);
    CHECK(result.steps == 2);
    CHECK(record_of(output("run"))["exit"] == "done");
}

TEST_CASE_METHOD(Runs, "a folder with a timeline is refused unless it may be overwritten", "[simulation]") {
    run(scene(), {.output = output("run")});
    CHECK_THROWS_AS(run(scene(), {.output = output("run")}), UserError);
    CHECK(record_of(output("run"))["exit"] == "done");
    CHECK_NOTHROW(run(scene(), {.output = output("run"), .overwrite = true}));
}

TEST_CASE_METHOD(Runs, "a run that replaces another reads nothing of what that one wrote", "[simulation]") {
    const Scene writing = scene_with_model(
        "lsystem: 1\nStart: { f = fopen(\"log/steps\", \"a\"); fprintf(f, \"begun\\n\"); fclose(f); }\n"
        "derivation length: 1\naxiom: F\nF --> FF\nendlsystem\n");
    fs::create_directories(output("run") / "files");
    std::ofstream(output("run") / "files" / "mine") << "kept";
    run(writing, {.output = output("run")});
    CHECK(text_of(output("run") / "files/log/steps") == "begun\n");
    run(writing, {.output = output("run"), .overwrite = true});
    CHECK(text_of(output("run") / "files/log/steps") == "begun\n");
    run(scene(), {.output = output("run"), .overwrite = true});
    CHECK_FALSE(fs::exists(output("run") / "files/log"));
    CHECK(text_of(output("run") / "files/mine") == "kept");
    CHECK(fs::exists(output("run") / "fields/light"));
    run(writing, {.output = output("run"), .overwrite = true});
    CHECK_FALSE(fs::exists(output("run") / "fields"));  // nobody records any
}

TEST_CASE_METHOD(Runs, "a mistake in the timeline's table leaves no folder behind", "[simulation]") {
    const Scene mistaken = scene(std::string(two_bushes) + "evry = 2\n");
    CHECK_THROWS_WITH(run(mistaken, {.output = output("run")}), Contains("did you mean 'every'?"));
    CHECK_FALSE(fs::exists(output("run")));
}
