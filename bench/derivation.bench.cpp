// Derivation: a bare D0L plant, a parametric tree, signals with two-sided context; each beside plain C++ for the rule.
// Items are modules written (visited, where the string does not grow).
#include "lsystem/model_builder.h"

#include <tbb/global_control.h>

#include <benchmark/benchmark.h>
#include <cstring>
#include <string>

using namespace espalier;
using namespace espalier::test;

namespace {

/// Derives `steps` steps again and again in reused memory, counting the modules of every new string.
void derive(benchmark::State& state, ModelBuilder& model, int steps, bool lineage, bool visits = false) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(0)));
    Derivation derivation(model.compiled(), {1, 0, lineage, std::size_t(-1), {}});
    ModuleString string, next;
    std::int64_t modules = 0;
    for (auto _ : state) {
        derivation.start(string);
        for (int k = 0; k < steps; ++k) {
            if (visits) modules += static_cast<std::int64_t>(string.size());
            derivation.step(string, next);
            std::swap(string, next);
            if (!visits) modules += static_cast<std::int64_t>(string.size());
        }
        benchmark::DoNotOptimize(string.letters.data());
    }
    state.SetItemsProcessed(modules);
}

void bare_plant(benchmark::State& state) {
    ModelBuilder model;
    model.system().axiom = model.word("X");
    model.rule("X", "F-[[X]+X]+F[+FX]-X");
    model.rule("F", "FF");
    derive(state, model, 10, false);
}
BENCHMARK(bare_plant)->Arg(1)->Arg(2)->UseRealTime();

void bare_plant_with_lineage(benchmark::State& state) {
    ModelBuilder model;
    model.system().axiom = model.word("X");
    model.rule("X", "F-[[X]+X]+F[+FX]-X");
    model.rule("F", "FF");
    derive(state, model, 10, true);
}
BENCHMARK(bare_plant_with_lineage)->Arg(1)->UseRealTime();

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

constexpr double r1 = 0.9, r2 = 0.6, wr = 0.707;

/// Honda's monopodial tree (ABOP figure 2.6).
void make_honda(ModelBuilder& model) {
    model.system().axiom = {model.module("A", {number(1), number(10)})};
    const auto rule = [&](const char* strict, const char* turn, double angle, const char* lateral, const char* apex) {
        std::vector<ModuleTemplate> successor = {
            model.module("!", {formal(1)}),
            model.module("F", {formal(0)}),
            model.module("[", {}),
            model.module(turn, {number(angle)}),
            model.module(lateral, {formal(0) * number(r2), formal(1) * number(wr)}),
            model.module("]", {})};
        if (std::string(strict) == "A") successor.push_back(model.module("/", {number(137.5)}));
        successor.push_back(model.module(apex, {formal(0) * number(r1), formal(1) * number(wr)}));
        model.rule({{strict, 2}}, std::move(successor));
    };
    rule("A", "&", 45, "B", "A");
    rule("B", "-", 45, "C", "C");
    rule("C", "+", 45, "B", "B");
}

void honda_tree(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    derive(state, model, 19, false);
}
BENCHMARK(honda_tree)->Arg(1)->Arg(2)->UseRealTime();

void honda_tree_with_lineage(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    derive(state, model, 19, true);
}
BENCHMARK(honda_tree_with_lineage)->Arg(1)->UseRealTime();

/// The same tree with a condition on every production, so that each apex runs two programs.
void honda_tree_with_conditions(benchmark::State& state) {
    ModelBuilder model;
    make_honda(model);
    for (Production& production : model.system().productions) {
        production.condition = number(0) < formal(0) * formal(1);
        production.successor.back().arguments[0] = formal(0) * number(r1) * number(1);
    }
    derive(state, model, 19, false);
}
BENCHMARK(honda_tree_with_conditions)->Arg(1)->UseRealTime();

void honda_tree_plain(benchmark::State& state) {
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

/// Two-sided contexts on a branching string (ABOP figure 1.31 a, Hogeweg and Hesper 1974).
void two_sided_context(benchmark::State& state) {
    ModelBuilder model;
    model.system().axiom = model.word("F1F1F1");
    model.system().filter = LSystem::Filter::ignore;
    for (const char* turn : {"+", "-", "F"}) model.system().filtered.push_back(model.model().alphabet.symbol(turn));
    const char* successors[] = {"0", "1[+F1F1]", "1", "1", "0", "1F1", "0", "0"};
    for (int k = 0; k < 8; ++k) {
        const std::string bits[] = {k & 4 ? "1" : "0", k & 2 ? "1" : "0", k & 1 ? "1" : "0"};
        model.rule(bits[0], bits[1], bits[2], successors[k]);
    }
    model.rule("+", "-");
    model.rule("-", "+");
    derive(state, model, 50, false, true);
}
BENCHMARK(two_sided_context)->Arg(1)->Arg(2)->UseRealTime();

void stochastic_bush(benchmark::State& state) {
    ModelBuilder model;
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
    derive(state, model, 18, true);
}
BENCHMARK(stochastic_bush)->Arg(1)->UseRealTime();

}  // namespace
