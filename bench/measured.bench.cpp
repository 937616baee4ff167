// Measured plants of 100,000 nodes, from their file to axes.
#include "espalier/language/measured_plants.h"

#include "language/large_plant.h"
#include "seconds_of.h"
#include "table.h"
#include "temporary_folder.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <fstream>

namespace espalier::bench {
namespace {

void read(benchmark::State& state, const char* file, large_plant::Write write) {
    const TemporaryFolder folder;
    write(std::ofstream(folder.path() / file));
    double least = 1e9;
    for (auto _ : state) {
        least = std::min(least, seconds_of([&] {
                             const MeasuredPlants plants = read_measured_plants(folder.path() / file);
                             if (plants.axes.size() != large_plant::branches + 1)
                                 state.SkipWithError("axes are missing");
                         }));
    }
    state.counters["value"] = 1000 * least;
}

void measured_rsml(benchmark::State& state) {
    read(state, "plant.rsml", large_plant::write_rsml);
}
BENCHMARK(measured_rsml)->UseRealTime();

void measured_mtg(benchmark::State& state) {
    read(state, "plant.mtg", large_plant::write_mtg);
}
BENCHMARK(measured_mtg)->UseRealTime();

void measured_cylinders(benchmark::State& state) {
    read(state, "plant.csv", large_plant::write_cylinders);
}
BENCHMARK(measured_cylinders)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row rsml{
    "a plant of 100,000 nodes from RSML, ms", "measured_rsml/real_time", "", Measure::value, Goal::at_most, 500};
const Row mtg{
    "the same from a multiscale tree graph, ms", "measured_mtg/real_time", "", Measure::value, Goal::at_most, 500};
const Row cylinders{
    "the same as cylinders, ms", "measured_cylinders/real_time", "", Measure::value, Goal::at_most, 500};

}  // namespace
}  // namespace espalier::bench
