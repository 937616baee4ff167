// Recording beside growing: the two trees with their timeline, every frame.
#include "espalier/simulation/world.h"
#include "espalier/timeline/timeline.h"

#include "seconds_of.h"
#include "table.h"
#include "temporary_folder.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <benchmark/benchmark.h>
#include <cstdint>
#include <filesystem>

namespace espalier::bench {
namespace {

namespace fs = std::filesystem;

struct Recorded {
    double waited = 0;     ///< seconds in the timeline's functions
    double grown = 0;      ///< seconds of everything else
    double shapes = 0;     ///< internodes, organs and polygons of all frames
    double megabytes = 0;  ///< of the frames' files
};

Recorded record(const Scene& scene) {
    const TemporaryFolder folder;
    const fs::path run = folder.path() / "run";
    Recorded recorded;
    World world(scene);
    Timeline timeline(run, scene.timeline, world.last_step());
    const auto record_frame = [&] {
        recorded.waited += seconds_of([&] { timeline.record(world.frame()); });
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            const PlantGeometry& geometry = world.interpretation(plant).geometry;
            recorded.shapes += double(geometry.internodes.size() + geometry.organs.size() + geometry.polygons.size());
        }
    };
    recorded.grown += seconds_of([&] { world.start(); });
    record_frame();
    while (!world.at_end()) {
        recorded.grown += seconds_of([&] { world.step(); });
        record_frame();
    }
    recorded.waited += seconds_of([&] { timeline.finish(); });
    for (const fs::directory_entry& file : fs::directory_iterator(run / "plants")) {
        recorded.megabytes += double(file.file_size()) / 1e6;
    }
    return recorded;
}

double grow(const Scene& scene) {
    World world(scene);
    return seconds_of([&] {
        world.start();
        while (!world.at_end()) world.step();
    });
}

Scene two_trees() {
    return read_scene(ESPALIER_SOURCE_DIR "/environments/two-trees.toml");
}

/// What the run waits for its timeline, with as many threads as the machine has.
void recording_two_trees(benchmark::State& state) {
    const Scene scene = two_trees();
    for (auto _ : state) {
        const Recorded recorded = record(scene);
        state.counters["work"] = recorded.waited;
        state.counters["yardstick"] = recorded.grown;
    }
}
BENCHMARK(recording_two_trees)->UseRealTime()->Unit(benchmark::kSecond)->Iterations(1);

constexpr std::int64_t every_core = 0;

/// The wall time of a whole run with its timeline, and of the growth alone, both grown by so many threads.
void recorded_run_two_trees(benchmark::State& state) {
    const auto threads = state.range(0) == every_core ? tbb::info::default_concurrency() : int(state.range(0));
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    const Scene scene = two_trees();
    for (auto _ : state) {
        const double alone = grow(scene);
        const Recorded recorded = record(scene);
        state.counters["work"] = recorded.waited + recorded.grown;
        state.counters["yardstick"] = alone;
        state.counters["value"] = 1e6 * recorded.megabytes / recorded.shapes;
    }
}
BENCHMARK(recorded_run_two_trees)->Arg(1)->Arg(every_core)->UseRealTime()->Unit(benchmark::kSecond)->Iterations(1);

const Row recording{"recording two-trees, against growing it",
                    "recording_two_trees/iterations:1/real_time",
                    "",
                    Row::Measure::counters,
                    Row::Goal::at_most,
                    0.2};
/// What "beside" is worth: the writer has a core that the growth leaves free.
const Row recorded_beside{"two-trees with its timeline, against without [1 thread, a core free]",
                          "recorded_run_two_trees/1/iterations:1/real_time",
                          "",
                          Row::Measure::counters,
                          Row::Goal::at_most,
                          1.2};
/// Where every core grows, what the writer does comes on top; it must take less than the growth itself.
const Row recorded_run{"two-trees with its timeline, against without [every core grows]",
                       "recorded_run_two_trees/0/iterations:1/real_time",
                       "",
                       Row::Measure::counters,
                       Row::Goal::at_most,
                       2};
const Row size{"two-trees: MB per 10^6 organs and internodes of a frame",
               "recorded_run_two_trees/0/iterations:1/real_time",
               "",
               Row::Measure::value,
               Row::Goal::at_most,
               150};

}  // namespace
}  // namespace espalier::bench
