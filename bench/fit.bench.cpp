// Growing for a fit: one of its simulations beside a start of the program, which grows the same plant.
#include "espalier/base/file.h"

#include "program_runs.h"
#include "study/fit/form.h"
#include "table.h"
#include "temporary_folder.h"

#include <benchmark/benchmark.h>
#include <stdexcept>

namespace espalier::bench {
namespace {

/// Some 200 nodes.
const char* const bush = R"(#define P 0.5
lsystem: 1
seed: 1
derivation length: 10
axiom: A
A : * --> F(0.1)[+(40)/(90)A]/(137.5)A : P
A : * --> F(0.1)/(137.5)A : 1-P
endlsystem
)";

/// As approximate Bayesian computation does it: another value of the parameter and other random numbers each time.
void simulate_bush(benchmark::State& state) {
    const TemporaryFolder folder;
    folder.write("bush.l", bush);
    const study::Growth growth(study::Subject{folder.path() / "bush.l"});
    std::uint64_t number = 0;
    for (auto _ : state) {
        const double probability = 0.4 + 0.2 * static_cast<double>(++number % 100) / 100;
        const auto scene = growth.scene(std::vector<std::pair<std::string, double>>{{"P", probability}});
        const auto grown = growth.grow(scene, number, {true, false});
        if (!grown) throw std::runtime_error("the bush did not grow");
        benchmark::DoNotOptimize(study::forms_of(*grown));
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(simulate_bush)->UseRealTime();

void run_bush(benchmark::State& state) {
    const TemporaryFolder folder;
    folder.write("bush.l", bush);
    const std::string path = folder.path().string();
    for (auto _ : state) {
        run_program(
            {"run", path + "/bush.l", "--threads", "1", "--output", path + "/output", "--quiet", "--overwrite"});
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(run_bush)->UseRealTime();

const Row simulation{"a simulation of a fit, against a start of the program that grows the same bush",
                     "simulate_bush/real_time",
                     "run_bush/real_time",
                     Row::Measure::rate,
                     Row::Goal::at_least,
                     20};

}  // namespace
}  // namespace espalier::bench
