// Scale: stands of trees that compete for light, with and without their timeline, and many small plants beside one
// large one. Items are modules of every step.
#include "espalier/simulation/simulation.h"
#include "espalier/simulation/world.h"
#include "espalier/timeline/timeline.h"

#include "seconds_of.h"
#include "table.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <string>

namespace espalier::bench {
namespace {

/// Grows a world by so many steps: seconds and modules of all of them.
struct Growth {
    double seconds = 0;
    std::int64_t modules = 0;

    void step(World& world) {
        seconds += seconds_of([&] { world.step(); });
        modules += static_cast<std::int64_t>(world.modules());
    }
};

/// Seven cycles of growth: some 900 modules a tree.
constexpr int cycles = 7, steps = cycles * (cycles + 7) / 2;

/// environments/forest.toml with so many trees.
Scene forest(std::int64_t trees) {
    const auto columns = std::llround(std::sqrt(double(trees)));
    const auto rows = (trees + columns - 1) / columns;
    SceneOptions options;
    options.overrides = {{"plant.0.grid.columns", std::to_string(columns)},
                         {"plant.0.grid.rows", std::to_string(rows)}};
    options.steps = steps;
    return read_scene(ESPALIER_SOURCE_DIR "/environments/forest.toml", options);
}

void forest(benchmark::State& state) {
    constexpr std::size_t bytes_of_a_tree = 500'000;
    if (static_cast<std::size_t>(state.range(0)) * bytes_of_a_tree > default_memory()) {
        return state.SkipWithError("half of this machine's memory does not hold so many trees");
    }
    const Scene scene = forest(state.range(0));
    Growth growth;
    for (auto _ : state) {
        World world(scene);
        world.start();
        const double before = growth.seconds;
        while (world.steps_done() < steps) growth.step(world);
        state.SetIterationTime(growth.seconds - before);
        state.counters["modules"] = double(world.modules());
    }
    state.SetItemsProcessed(growth.modules);
}
BENCHMARK(forest)->Arg(100)->Arg(1000)->Arg(10000)->UseManualTime()->Unit(benchmark::kSecond)->Iterations(1);

double resident_kilobytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6));
    }
    return 0;
}

/// The most that a stand of which nothing is recorded takes in the last steps; `resident`: of so many trees in memory
/// at a time, the others wait on disk.
double kilobytes_of_stand(std::int64_t trees, std::optional<std::int64_t> resident) {
    const TemporaryFolder folder;
    malloc_trim(0);
    const double before = resident_kilobytes();
    WorldOptions options;
    options.is_looked_at = false;  // as in a run
    if (resident) options.blocks = BlocksOnDisk{folder.path(), static_cast<std::size_t>(trees / *resident)};
    World world(forest(trees), options);
    world.start();
    double most = 0;
    while (world.steps_done() < steps) {
        world.step();
        most = std::max(most, resident_kilobytes());
    }
    return most - before;
}

/// What a tree takes more in a larger stand.
void memory_of_a_tree(benchmark::State& state) {
    constexpr std::int64_t few = 100, many = 900;
    for (auto _ : state) {
        const double small = kilobytes_of_stand(few, {}), large = kilobytes_of_stand(many, {});
        state.counters["value"] = (large - small) / (many - few);
    }
}
BENCHMARK(memory_of_a_tree)->Iterations(1);

void memory_of_a_waiting_tree(benchmark::State& state) {
    constexpr std::int64_t few = 900, many = 4900, resident = 100;
    for (auto _ : state) {
        const double small = kilobytes_of_stand(few, resident), large = kilobytes_of_stand(many, resident);
        state.counters["value"] = (large - small) / (many - few);
    }
}
BENCHMARK(memory_of_a_waiting_tree)->Iterations(1);

/// The last steps of a stand and their frames.
void forest_recorded(benchmark::State& state) {
    constexpr int recorded = 4;
    const Scene scene = forest(state.range(0));
    for (auto _ : state) {
        const TemporaryFolder folder;
        World world(scene);
        world.start();
        while (world.steps_done() < steps - recorded) world.step();
        Timeline timeline(folder.path() / "run", scene.timeline, steps);
        double recording = 0;
        Growth growth;
        while (world.steps_done() < steps) {
            growth.step(world);
            recording += seconds_of([&] { timeline.record(world.frame()); });
        }
        recording += seconds_of([&] { timeline.finish(); });
        state.SetIterationTime(recording);
        state.counters["work"] = recording;
        state.counters["yardstick"] = growth.seconds;
    }
}
BENCHMARK(forest_recorded)->Arg(1000)->UseManualTime()->Unit(benchmark::kSecond)->Iterations(1);

/// L(n) becomes n herbs of 24 modules each, which then only stretch.
const char* const herbs = R"(
#define COUNT 1
lsystem: 1
derivation length: 100
axiom: L(COUNT)
L(n) : n > 1 --> L(floor(n / 2)) L(n - floor(n / 2))
L(n) --> f(1) [ F(1) [ +(30) F(0.5) [ &(40) F(0.2) ] F(0.3) ] F(0.8) [ -(30) F(0.5) [ ^(40) F(0.2) ] F(0.3) ] F(0.6) ]
F(l) --> F(l * 1.001)
endlsystem
)";

/// A world of so many plants that hold as many herbs in all as `herbs` says.
void herbs_in_plants(benchmark::State& state) {
    constexpr int unfolding = 15, measured = 20;
    const std::int64_t all = 10'000, plants = state.range(0);
    const TemporaryFolder folder;
    folder.write("herbs.l", herbs);
    const Scene scene = read_scene_text(
        fmt::format("[simulation]\nsteps = 100\n[[plant]]\nmodel = 'herbs.l'\ndefine = {{ COUNT = {} }}\n"
                    "grid = {{ columns = {}, spacing = 1.0 }}\n",
                    all / plants, plants),
        "herbs.toml", folder.path());
    World world(scene);
    world.start();
    while (world.steps_done() < unfolding) world.step();
    Growth growth;
    for (auto _ : state) {
        const double before = growth.seconds;
        for (int k = 0; k < measured; ++k) growth.step(world);
        state.SetIterationTime(growth.seconds - before);
    }
    state.SetItemsProcessed(growth.modules);
}
BENCHMARK(herbs_in_plants)->Arg(1)->Arg(625)->Arg(10000)->UseManualTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row small_plants{"10,000 small plants, a module's time against one large plant",
                       "herbs_in_plants/10000/manual_time",
                       "herbs_in_plants/1/manual_time",
                       Measure::time_per_item,
                       Goal::at_most,
                       1.2};
const Row middling_plants{"625 small plants of 384 modules, a module's time against one large plant",
                          "herbs_in_plants/625/manual_time",
                          "herbs_in_plants/1/manual_time",
                          Measure::time_per_item,
                          Goal::at_most,
                          1.2};
const Row thousand{"forest of 1,000 trees, a module's time against 100",
                   "forest/1000/iterations:1/manual_time",
                   "forest/100/iterations:1/manual_time",
                   Measure::time_per_item,
                   Goal::at_most,
                   1.2};
const Row ten_thousand{"forest of 10,000 trees, a module's time against 1,000",
                       "forest/10000/iterations:1/manual_time",
                       "forest/1000/iterations:1/manual_time",
                       Measure::time_per_item,
                       Goal::at_most,
                       1.2};
const Row memory{"memory of a tree of environments/forest.toml, of which nothing is recorded, kB",
                 "memory_of_a_tree/iterations:1",
                 "",
                 Row::Measure::value,
                 Row::Goal::at_most,
                 150};
const Row waiting_memory{"memory of a tree of the same, of which 100 are in memory at a time, kB",
                         "memory_of_a_waiting_tree/iterations:1",
                         "",
                         Row::Measure::value,
                         Row::Goal::at_most,
                         30};
const Row recorded{"recording a forest of 1,000 trees, against growing it",
                   "forest_recorded/1000/iterations:1/manual_time",
                   "",
                   Measure::counters,
                   Goal::at_most,
                   1};

}  // namespace
}  // namespace espalier::bench
