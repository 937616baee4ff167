// Recording beside growing: the two trees with their timeline, every frame.
#include "espalier/simulation/world.h"
#include "espalier/timeline/timeline.h"

#include "table.h"
#include "temporary_folder.h"

#include <benchmark/benchmark.h>
#include <chrono>

namespace espalier::bench {
namespace {

/// Seconds of recording over seconds of everything else.
void recording_two_trees(benchmark::State& state) {
    const Scene scene = read_scene(ESPALIER_SOURCE_DIR "/environments/two-trees.toml");
    double recorded = 0, grown = 0;
    const auto timed = [](double& sum, const auto& work) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    for (auto _ : state) {
        const TemporaryFolder folder;
        World world(scene);
        Timeline timeline(folder.path() / "run", scene.timeline, scene.steps);
        timed(grown, [&] { world.start(); });
        timed(recorded, [&] { timeline.record(world.frame()); });
        while (world.steps_done() < scene.steps) {
            timed(grown, [&] { world.step(); });
            timed(recorded, [&] { timeline.record(world.frame()); });
        }
        timed(recorded, [&] { timeline.finish(); });
    }
    state.counters["value"] = recorded / grown;
}
BENCHMARK(recording_two_trees)->UseRealTime()->Unit(benchmark::kSecond)->Iterations(1);

const Row recording{"recording two-trees, against growing it",
                    "recording_two_trees/iterations:1/real_time",
                    "",
                    Row::Measure::value,
                    Row::Goal::at_most,
                    0.2};

}  // namespace
}  // namespace espalier::bench
