// Interpretation of a tree beside a bare scan of its columns, and what questions at every apex add to a step.
#include "espalier/turtle/interpretation.h"

#include "espalier/environment/environment.h"

#include "growing.h"

namespace espalier::bench {
namespace {

using namespace test;

constexpr int steps = 16;

/// The tree of 2^16 apices.
struct Tree {
    explicit Tree(bool asks = false) {
        make_honda(model);
        if (asks) ask();
        compiled = model.compiled();
        derivation.emplace(compiled);
        string = grow(*derivation, steps);
        symbols = symbol_table(model.model());
    }

    /// Puts ?P(0, 0, 0) behind every apex, of branches, too.
    void ask() {
        for (Production& production : model.system().productions) {
            std::vector<ModuleTemplate> asking;
            for (ModuleTemplate& module : production.successor) {
                const bool apex =
                    std::string("ABC").find(model.model().alphabet.name(module.letter)) != std::string::npos;
                asking.push_back(std::move(module));
                if (!apex) continue;
                asking.push_back(model.module("?", {}));
                asking.push_back(model.module("P", {number(0), number(0), number(0)}));
            }
            production.successor = std::move(asking);
        }
        model.rule(std::vector<Pattern>{{"?", 0}, {"P", 3}}, {});
    }

    ModelBuilder model;
    std::shared_ptr<const CompiledModel> compiled;
    std::optional<Derivation> derivation;
    std::shared_ptr<const SymbolTable> symbols;
    ModuleString string;
    TurtleSettings settings;
    Interpretation interpretation;
};

void interpretation(benchmark::State& state) {
    const tbb::global_control control = threads(state);
    Tree tree;
    for (auto _ : state) {
        interpret(tree.model.model(), *tree.symbols, tree.string, tree.settings, nullptr, {}, tree.interpretation);
        benchmark::DoNotOptimize(tree.interpretation.geometry.bounds);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(tree.string.size()));
}
BENCHMARK(interpretation)->Arg(1)->Arg(2)->UseRealTime();

void bare_scan(benchmark::State& state) {
    Tree tree;
    const auto arities = tree.model.model().alphabet.arities();
    for (auto _ : state) {
        const double* value = tree.string.parameters.data();
        double sum = 0;
        for (const LetterId letter : tree.string.letters) {
            for (const double* end = value + arities[letter]; value != end; ++value) sum += *value;
        }
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(tree.string.size()));
}
BENCHMARK(bare_scan)->UseRealTime();

/// One whole step: derive, interpret, exchange.
void step_of(benchmark::State& state, bool asks) {
    Tree tree(asks);
    Environment environment({}, {});
    ModuleString next;
    for (auto _ : state) {
        state.PauseTiming();
        tree.derivation.emplace(tree.compiled);
        tree.string = grow(*tree.derivation, steps - 1);
        state.ResumeTiming();
        tree.derivation->step(tree.string, next);
        interpret(tree.model.model(), *tree.symbols, next, tree.settings, nullptr, {}, tree.interpretation);
        const PlantView view{0, &tree.model.model(), &next, &tree.interpretation};
        ModuleString* strings[] = {&next};
        environment.exchange({steps, steps, 1, {&view, 1}}, strings);
    }
}

void step_with_questions(benchmark::State& state) {
    step_of(state, true);
}
BENCHMARK(step_with_questions)->UseRealTime();

void step_without_questions(benchmark::State& state) {
    step_of(state, false);
}
BENCHMARK(step_without_questions)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row walk{"interpretation, against a bare scan of the columns",
               "interpretation/1/real_time",
               "bare_scan/real_time",
               Measure::rate,
               Goal::at_least,
               0.15};
const Row walk_2{"interpretation with 2 threads, against one",
                 "interpretation/2/real_time",
                 "interpretation/1/real_time",
                 Measure::speedup,
                 Goal::at_least,
                 1.7};
const Row questions{"step with a question at each of 65,536 apices, against none",
                    "step_with_questions/real_time",
                    "step_without_questions/real_time",
                    Measure::time,
                    Goal::at_most,
                    1.5};

}  // namespace
}  // namespace espalier::bench
