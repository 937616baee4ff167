// A graph of components that expands to ten million instances, from its text to its last string, beside the derivation
// of the model that it is translated into. Items are instances.
#include "espalier/language/notation.h"
#include "espalier/language/reader.h"

#include "growing.h"

#include <string>

namespace espalier::bench {
namespace {

constexpr int steps = 3;
constexpr std::int64_t instances = 10'000'000;
const std::string graph =
    "pgraph 1\nHydra shoots\n  count 2500\nPhiball head\n  count 4000\nSimple floret\n  shape sphere\n"
    "camera -> shoots -> head -> floret\n";

std::shared_ptr<const CompiledModel> compiled(const std::string& model) {
    return compile(read_model_text(model, "head.l", {}));
}

std::string model_of_graph() {
    return language::translated(*notation_of("head.pgraph"), graph, "head.pgraph").text;
}

void grow(benchmark::State& state, const std::shared_ptr<const CompiledModel>& model) {
    Derivation derivation(model);
    ModuleString string, next;
    derivation.start(string);
    for (int k = 0; k < steps; ++k) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    benchmark::DoNotOptimize(string.letters.data());
    if (string.size() < std::size_t{instances}) state.SkipWithError("instances are missing");
}

void large_graph(benchmark::State& state) {
    for (auto _ : state) grow(state, compiled(model_of_graph()));
    state.SetItemsProcessed(instances * state.iterations());
}
BENCHMARK(large_graph)->UseRealTime();

void large_graph_translated(benchmark::State& state) {
    const auto model = compiled(model_of_graph());
    for (auto _ : state) grow(state, model);
    state.SetItemsProcessed(instances * state.iterations());
}
BENCHMARK(large_graph_translated)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;

const Row large_graph_time{"graph of 10,000,000 instances, against its translation",
                           "large_graph/real_time",
                           "large_graph_translated/real_time",
                           Measure::time,
                           Goal::at_most,
                           2};

}  // namespace
}  // namespace espalier::bench
