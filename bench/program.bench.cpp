// The program as users start it: what a run without recorders takes beside deriving the last string alone, and the most
// memory that it holds.
#include "program_runs.h"
#include "table.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

namespace espalier::bench {
namespace {

const char* const plant = R"(lsystem: 1
derivation length: 10
axiom: X
X --> F-[[X]+X]+F[+FX]-X
F --> FF
endlsystem
)";

const char* const tree = R"(lsystem: 1
derivation length: 20
axiom: A(1,10)
A(l,w) --> !(w)F(l)[&(45)B(l*0.6,w*0.707)]/(137.5)A(l*0.9,w*0.707)
B(l,w) --> !(w)F(l)[-(45)C(l*0.6,w*0.707)]C(l*0.9,w*0.707)
C(l,w) --> !(w)F(l)[+(45)B(l*0.6,w*0.707)]B(l*0.9,w*0.707)
endlsystem
)";

const char* const alga = R"(lsystem: 1
derivation length: 3
axiom: A
A --> AB
endlsystem
)";

const char* const scene = R"([[plant]]
model = "model.l"
[timeline]
statistics = false
skeleton = false
lifespans = false
)";

/// By the run's own record, in MB: what the system says of a child counts this program's memory, too.
double most_memory(const std::string& run) {
    return nlohmann::json::parse(std::ifstream(run + "/run.json")).at("peak_memory").get<double>() / (1 << 20);
}

void measure(benchmark::State& state, const char* model, bool runs) {
    const TemporaryFolder folder;
    folder.write("model.l", model);
    folder.write("scene.toml", scene);
    const std::string path = folder.path().string();
    const std::vector<std::string> run{"run",      path + "/scene.toml", "--threads", "1",
                                       "--output", path + "/output",     "--quiet",   "--overwrite"};
    const std::vector<std::string> derive{"derive", path + "/model.l", "--format", "counts"};
    for (auto _ : state) run_program(runs ? run : derive);
    if (runs) state.counters["value"] = most_memory(path + "/output");
}

void run_plant(benchmark::State& state) {
    measure(state, plant, true);
}
BENCHMARK(run_plant)->UseRealTime();

void derive_plant(benchmark::State& state) {
    measure(state, plant, false);
}
BENCHMARK(derive_plant)->UseRealTime();

void run_tree(benchmark::State& state) {
    measure(state, tree, true);
}
BENCHMARK(run_tree)->UseRealTime();

void derive_tree(benchmark::State& state) {
    measure(state, tree, false);
}
BENCHMARK(derive_tree)->UseRealTime();

/// Most of it is loading libraries.
void derive_alga(benchmark::State& state) {
    const TemporaryFolder folder;
    folder.write("model.l", alga);
    using Clock = std::chrono::steady_clock;
    std::chrono::duration<double, std::milli> shortest{1e9};
    for (auto _ : state) {
        const auto begin = Clock::now();
        run_program({"derive", (folder.path() / "model.l").string()});
        shortest = std::min<std::chrono::duration<double, std::milli>>(shortest, Clock::now() - begin);
    }
    state.counters["value"] = shortest.count();
}
BENCHMARK(derive_alga)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row plant_run{"bare D0L plant, espalier run without recorders, against espalier derive",
                    "run_plant/real_time",
                    "derive_plant/real_time",
                    Measure::time,
                    Goal::at_most,
                    2};
const Row tree_run{"parametric tree, espalier run without recorders, against espalier derive",
                   "run_tree/real_time",
                   "derive_tree/real_time",
                   Measure::time,
                   Goal::at_most,
                   2};
const Row start{
    "espalier derive of a model of three lines, ms", "derive_alga/real_time", "", Measure::value, Goal::at_most, 20};
const Row plant_memory{"bare D0L plant, espalier run without recorders: MB at most",
                       "run_plant/real_time",
                       "",
                       Measure::value,
                       Goal::at_most,
                       120};

}  // namespace
}  // namespace espalier::bench
