// A stand on two ranks of mpiexec, and one whose plants wait on disk, beside stands on two threads of one process.
#include "table.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <benchmark/benchmark.h>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace espalier::bench {
namespace {

/// A square of trees, 49 steps, of which nothing but the times is recorded. `launch` stands before the program.
void grow_stand(benchmark::State& state, int side, const std::string& launch, const std::string& options) {
    const TemporaryFolder folder;
    const std::string command = fmt::format(
        "{} '" ESPALIER_PROGRAM "' run '" ESPALIER_SOURCE_DIR
        "/environments/forest.toml' --set plant.0.grid.columns={} --set plant.0.grid.rows={} --set timeline.fields=[] "
        "--set timeline.skeleton=false --set timeline.lifespans=false --set timeline.statistics=false {} --quiet "
        "--overwrite --output '{}/run'",
        launch, side, side, options, folder.path().string());
    for (auto _ : state) {
        if (std::system(command.c_str()) != 0) throw std::runtime_error("this failed: " + command);
    }
    state.SetItemsProcessed(state.iterations() * side * side);
}

void stand_on_ranks(benchmark::State& state) {
    grow_stand(state, 30, "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpiexec -n 2", "--threads 1");
}
BENCHMARK(stand_on_ranks)->UseRealTime();

void stand_on_threads(benchmark::State& state) {
    grow_stand(state, 30, "", "--threads 2");
}
BENCHMARK(stand_on_threads)->UseRealTime();

void stand_in_blocks(benchmark::State& state) {
    grow_stand(state, 30, "", "--threads 2 --blocks 10");
}
BENCHMARK(stand_in_blocks)->UseRealTime();

void large_stand_in_blocks(benchmark::State& state) {
    grow_stand(state, 90, "", "--threads 2 --blocks 90");
}
BENCHMARK(large_stand_in_blocks)->UseRealTime();

const Row ranks{"a stand of 900 trees on two ranks, against two threads of one process",
                "stand_on_ranks/real_time",
                "stand_on_threads/real_time",
                Row::Measure::time,
                Row::Goal::at_most,
                1.5};
const Row blocks{"a stand of 900 trees of which 90 are in memory at a time, against all",
                 "stand_in_blocks/real_time",
                 "stand_on_threads/real_time",
                 Row::Measure::time,
                 Row::Goal::at_most,
                 2};
const Row large{"a stand of 8,100 trees of which 90 are in memory at a time, a tree's time against 900",
                "large_stand_in_blocks/real_time",
                "stand_in_blocks/real_time",
                Row::Measure::time_per_item,
                Row::Goal::at_most,
                1.3};

}  // namespace
}  // namespace espalier::bench
