// Derivation as runs do it, with lineage: a bare D0L plant and a parametric tree, each beside plain C++ for its rule,
// which keeps no lineage; a stochastic bush. Items are modules written.
#include "growing.h"

#include <string>

namespace espalier::bench {
namespace {

using namespace test;

void bare_plant(benchmark::State& state) {
    ModelBuilder model;
    make_bare_plant(model);
    derive(state, model, {.steps = 10, .lineage = true});
}
BENCHMARK(bare_plant)->Arg(1)->UseRealTime();

void bare_plant_without_lineage(benchmark::State& state) {
    ModelBuilder model;
    make_bare_plant(model);
    derive(state, model, {.steps = 10});
}
BENCHMARK(bare_plant_without_lineage)->Arg(1)->UseRealTime();

void bare_plant_copied(benchmark::State& state) {
    ModelBuilder model;
    make_bare_plant(model);
    copy(state, model, {.steps = 10, .lineage = true});
}
BENCHMARK(bare_plant_copied)->UseRealTime();

void bare_plant_plain(benchmark::State& state) {
    std::int64_t modules = 0;
    for (auto _ : state) {
        std::string string = "X", next;
        for (int k = 0; k < 10; ++k) {
            next.clear();
            for (const char letter : string) {
                if (letter == 'X')
                    next += "F-[[X]+X]+F[+FX]-X";
                else if (letter == 'F')
                    next += "FF";
                else
                    next += letter;
            }
            std::swap(string, next);
            modules += static_cast<std::int64_t>(string.size());
        }
        benchmark::DoNotOptimize(string.data());
    }
    state.SetItemsProcessed(modules);
}
BENCHMARK(bare_plant_plain)->UseRealTime();

void honda_tree(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    derive(state, model, {.steps = 19, .lineage = true});
}
BENCHMARK(honda_tree)->Arg(1)->Arg(2)->UseRealTime();

void honda_tree_without_lineage(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    derive(state, model, {.steps = 19});
}
BENCHMARK(honda_tree_without_lineage)->Arg(1)->UseRealTime();

void honda_tree_copied(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    copy(state, model, {.steps = 19, .lineage = true});
}
BENCHMARK(honda_tree_copied)->UseRealTime();

/// The same tree with a condition on every production, so that each apex runs two programs.
void honda_tree_with_conditions(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    for (Production& production : model.system().productions) {
        production.condition = number(0) < formal(0) * formal(1);
        production.successor.back().arguments[0] = formal(0) * number(0.9) * number(1);
    }
    derive(state, model, {.steps = 19, .lineage = true});
}
BENCHMARK(honda_tree_with_conditions)->Arg(1)->UseRealTime();

/// The same tree with && in every condition and ?: in a value of every successor.
void honda_tree_with_choices(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    for (Production& production : model.system().productions) {
        production.condition = apply(Operator::logical_and, {number(0) < formal(0), number(0) < formal(1)});
        production.successor.back().arguments[0] =
            choose(formal(0) < formal(1), formal(0) * number(0.9), formal(0) * number(0.8));
    }
    derive(state, model, {.steps = 19, .lineage = true});
}
BENCHMARK(honda_tree_with_choices)->Arg(1)->UseRealTime();

void honda_tree_plain(benchmark::State& state) {
    constexpr double r1 = 0.9, r2 = 0.6, wr = 0.707;
    ModuleString string, next;
    Alphabet alphabet;
    enum { A = 3, B, C, turn_a, turn_b, turn_c, roll, width, forward };
    static constexpr int arity[] = {0, 0, 0, 2, 2, 2, 1, 1, 1, 1, 1, 1};
    std::int64_t modules = 0;
    for (auto _ : state) {
        string.clear();
        const double axiom[] = {1, 10};
        string.append(A, axiom);
        for (int k = 0; k < 19; ++k) {
            std::size_t size = 0, values = 0;
            for (const LetterId letter : string.letters) {
                size += letter == A ? 8 : letter == B || letter == C ? 7 : 1;
                values += letter == A ? 8 : letter == B || letter == C ? 7 : arity[letter];
            }
            next.letters.resize(size);
            next.parameters.resize(values);
            LetterId* out = next.letters.data();
            double* to = next.parameters.data();
            const double* from = string.parameters.data();
            for (const LetterId letter : string.letters) {
                if (letter < A || letter > C) {
                    *out++ = letter;
                    if (arity[letter] > 0) *to++ = *from++;
                    continue;
                }
                const double l = from[0], w = from[1];
                from += 2;
                const LetterId lateral = letter == B ? C : B, apex = letter == A ? A : letter == B ? C : B;
                *out++ = width, *out++ = forward, *out++ = Alphabet::open_bracket;
                *out++ = static_cast<LetterId>(letter + turn_a - A), *out++ = lateral, *out++ = Alphabet::close_bracket;
                *to++ = w, *to++ = l, *to++ = 45, *to++ = l * r2, *to++ = w * wr;
                if (letter == A) *out++ = roll, *to++ = 137.5;
                *out++ = apex;
                *to++ = l * r1, *to++ = w * wr;
            }
            std::swap(string, next);
            modules += static_cast<std::int64_t>(string.size());
        }
        benchmark::DoNotOptimize(string.parameters.data());
    }
    state.SetItemsProcessed(modules);
}
BENCHMARK(honda_tree_plain)->UseRealTime();

void make_stochastic_bush(ModelBuilder& model) {
    model.system().seed = number(1);
    model.system().axiom = {model.module("A", {number(1)})};
    const auto branch = [&](double angle, double scale) {
        return std::vector<ModuleTemplate>{model.module("F", {formal(0)}),
                                           model.module("[", {}),
                                           model.module("+", {number(angle)}),
                                           model.module("A", {formal(0) * number(scale)}),
                                           model.module("]", {}),
                                           model.module("A", {formal(0) * number(0.9)})};
    };
    model.rule({{"A", 1}}, branch(30, 0.7)).weight = number(2);
    model.rule({{"A", 1}}, branch(-30, 0.5)).weight = number(1);
}

void stochastic_bush(benchmark::State& state) {
    ModelBuilder model;
    make_stochastic_bush(model);
    derive(state, model, {.steps = 18, .lineage = true});
}
BENCHMARK(stochastic_bush)->Arg(1)->UseRealTime();

void parametric_bush(benchmark::State& state) {
    ModelBuilder model;
    make_bush(model, false);
    derive(state, model, {.steps = 17, .lineage = true});
}
BENCHMARK(parametric_bush)->Arg(1)->UseRealTime();

void bush_with_blocks(benchmark::State& state) {
    ModelBuilder model;
    make_bush(model, true);
    derive(state, model, {.steps = 17, .lineage = true});
}
BENCHMARK(bush_with_blocks)->Arg(1)->UseRealTime();

/// The stochastic bush with a condition on both productions.
void stochastic_bush_with_conditions(benchmark::State& state) {
    ModelBuilder model;
    make_stochastic_bush(model);
    for (Production& production : model.system().productions) production.condition = number(0.01) < formal(0);
    derive(state, model, {.steps = 20, .lineage = true});
}
BENCHMARK(stochastic_bush_with_conditions)->Arg(1)->UseRealTime();

/// Bytes held for a whole tree, over what its content takes: 2 a symbol, 8 a parameter, and 8 a module for its lineage.
void bytes_per_module(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    double ratio = 0;
    for (auto _ : state) {
        Derivation derivation(model.compiled(), with_lineage());
        const ModuleString string = grow(derivation, 18);
        ratio = double(string.bytes()) / double(10 * string.size() + 8 * string.parameters.size());
    }
    state.counters["value"] = ratio;
}
BENCHMARK(bytes_per_module)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
// The yardstick writes one byte a module, a string two, and with its lineage eighteen.
const Row bare{"bare D0L plant, against plain C++ with std::string and no lineage",
               "bare_plant/1/real_time",
               "bare_plant_plain/real_time",
               Measure::rate,
               Goal::at_least,
               0.1};
const Row bare_without{"bare D0L plant without lineage, against the same",
                       "bare_plant_without_lineage/1/real_time",
                       "bare_plant_plain/real_time",
                       Measure::rate,
                       Goal::at_least,
                       0.35};
// Memory sets the pace, and what a string without lineage takes says nothing of that.
const Row bare_copied{"bare D0L plant, against copying its strings",
                      "bare_plant/1/real_time",
                      "bare_plant_copied/real_time",
                      Measure::rate,
                      Goal::at_least,
                      0.25};
const Row honda{"parametric tree, against C++ written for its rule and no lineage",
                "honda_tree/1/real_time",
                "honda_tree_plain/real_time",
                Measure::rate,
                Goal::at_least,
                0.25};
const Row honda_without{"parametric tree without lineage, against the same",
                        "honda_tree_without_lineage/1/real_time",
                        "honda_tree_plain/real_time",
                        Measure::rate,
                        Goal::at_least,
                        0.4};
const Row honda_copied{"parametric tree, against copying its strings",
                       "honda_tree/1/real_time",
                       "honda_tree_copied/real_time",
                       Measure::rate,
                       Goal::at_least,
                       0.3};
const Row honda_conditions{"parametric tree with a condition and a program each, against that C++",
                           "honda_tree_with_conditions/1/real_time",
                           "honda_tree_plain/real_time",
                           Measure::rate,
                           Goal::at_least,
                           0.2};
const Row honda_choices{"parametric tree with && and ?: in its programs, against that C++",
                        "honda_tree_with_choices/1/real_time",
                        "honda_tree_plain/real_time",
                        Measure::rate,
                        Goal::at_least,
                        0.18};
const Row honda_2{"parametric tree with 2 threads, against one",
                  "honda_tree/2/real_time",
                  "honda_tree/1/real_time",
                  Measure::speedup,
                  Goal::at_least,
                  1.5};
const Row bush{"stochastic parametric bush, against the parametric tree",
               "stochastic_bush/1/real_time",
               "honda_tree/1/real_time",
               Measure::rate,
               Goal::at_least,
               0.5};
const Row bush_of_all{"bush with conditions, random numbers and powers, against the parametric tree",
                      "parametric_bush/1/real_time",
                      "honda_tree/1/real_time",
                      Measure::rate,
                      Goal::at_least,
                      0.3};
const Row blocks{"the same with variables in blocks, against the same",
                 "bush_with_blocks/1/real_time",
                 "honda_tree/1/real_time",
                 Measure::rate,
                 Goal::at_least,
                 0.3};
const Row conditional{"stochastic bush with conditions, against the parametric tree",
                      "stochastic_bush_with_conditions/1/real_time",
                      "honda_tree/1/real_time",
                      Measure::rate,
                      Goal::at_least,
                      0.3};
const Row bytes{
    "bytes per module, against its content", "bytes_per_module/real_time", "", Measure::value, Goal::at_most, 1.25};

}  // namespace
}  // namespace espalier::bench
