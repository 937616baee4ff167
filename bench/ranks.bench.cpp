// A stand on two ranks of mpiexec beside the same stand on two threads of one process.
#include "table.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <benchmark/benchmark.h>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace espalier::bench {
namespace {

/// 900 trees, 49 steps, of which nothing but the times is recorded. `launch` stands before the program.
void grow_stand(benchmark::State& state, const std::string& launch, int threads) {
    const TemporaryFolder folder;
    const std::string command = fmt::format(
        "{} '" ESPALIER_PROGRAM "' run '" ESPALIER_SOURCE_DIR
        "/environments/forest.toml' --set plant.0.grid.columns=30 --set plant.0.grid.rows=30 --set timeline.fields=[] "
        "--set "
        "timeline.skeleton=false --set timeline.lifespans=false --set timeline.statistics=false --threads {} --quiet "
        "--overwrite --output '{}/run'",
        launch, threads, folder.path().string());
    for (auto _ : state) {
        if (std::system(command.c_str()) != 0) throw std::runtime_error("this failed: " + command);
    }
}

void stand_on_ranks(benchmark::State& state) {
    grow_stand(state, "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpiexec -n 2", 1);
}
BENCHMARK(stand_on_ranks)->UseRealTime();

void stand_on_threads(benchmark::State& state) {
    grow_stand(state, "", 2);
}
BENCHMARK(stand_on_threads)->UseRealTime();

const Row ranks{"a stand of 900 trees on two ranks, against two threads of one process",
                "stand_on_ranks/real_time",
                "stand_on_threads/real_time",
                Row::Measure::time,
                Row::Goal::at_most,
                1.5};

}  // namespace
}  // namespace espalier::bench
