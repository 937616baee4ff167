// Contexts that reach far: a right context beyond 8,000 nested branches must cost what the pattern is long.
#include "growing.h"

#include <string>

namespace espalier::bench {
namespace {

constexpr int nested = 8000;

/// A[A[A[...]B]B]B: every A has its B behind the whole branch that stands between them.
void nested_branches(benchmark::State& state, bool with_context) {
    test::ModelBuilder model;
    std::string word;
    for (int k = 0; k < nested; ++k) word += "A[";
    word += "A";
    for (int k = 0; k < nested; ++k) word += "]B";
    model.system().axiom = model.word(word);
    if (with_context)
        model.rule("", "A", "B", "A");
    else
        model.rule("A", "A");
    derive(state, model, {.steps = 20, .lineage = true, .counts = Counts::visits});
}

void right_context_across_branches(benchmark::State& state) {
    nested_branches(state, true);
}
BENCHMARK(right_context_across_branches)->Arg(1)->UseRealTime();

void nested_branches_without_context(benchmark::State& state) {
    nested_branches(state, false);
}
BENCHMARK(nested_branches_without_context)->Arg(1)->UseRealTime();

/// Two-sided contexts on a branching string (ABOP figure 1.31 a, Hogeweg and Hesper 1974).
void two_sided_context(benchmark::State& state) {
    test::ModelBuilder model;
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
    derive(state, model, {.steps = 50, .lineage = true, .counts = Counts::visits});
}
BENCHMARK(two_sided_context)->Arg(1)->Arg(2)->UseRealTime();

/// A signal that climbs a shoot of 20,000 internodes with side branches, a condition on each side (ABOP section 3.2).
void signals_with_parameters(benchmark::State& state) {
    using namespace test;
    constexpr int internodes = 20'000;
    ModelBuilder model;
    LSystem& system = model.system();
    system.filter = LSystem::Filter::consider;
    for (const char* symbol : {"I", "[", "]"}) system.filtered.push_back(model.model().alphabet.symbol(symbol));
    for (int k = 0; k < internodes; ++k) {
        system.axiom.push_back(model.module("I", {number(k), number(k == 0 ? 1 : 0)}));
        if (k % 3 == 0) {
            system.axiom.push_back(model.module("[", {}));
            system.axiom.push_back(model.module("I", {number(-1), number(0)}));
            system.axiom.push_back(model.module("]", {}));
        }
        system.axiom.push_back(model.module("/", {number(137.5)}));
    }
    Production climbs = model.make({{"I", 2}}, {{"I", 2}}, {}, {model.module("I", {formal(2), number(1)})});
    climbs.condition = number(0) < formal(1);
    model.add(std::move(climbs));
    Production falls =
        model.make({}, {{"I", 2}}, {{"I", 2}}, {model.module("I", {formal(0), formal(3) * number(0.5)})});
    falls.condition = number(0) < formal(3);
    model.add(std::move(falls));
    derive(state, model, {.steps = 50, .lineage = true, .counts = Counts::visits});
}
BENCHMARK(signals_with_parameters)->Arg(1)->UseRealTime();

const Row across{"right context across 8,000 nested branches, against none",
                 "right_context_across_branches/1/real_time",
                 "nested_branches_without_context/1/real_time",
                 Row::Measure::time,
                 Row::Goal::at_most,
                 3};
const Row hogeweg{"two-sided context (visits), against the parametric tree",
                  "two_sided_context/1/real_time",
                  "honda_tree/1/real_time",
                  Row::Measure::rate,
                  Row::Goal::at_least,
                  0.5};
const Row hogeweg_2{"two-sided context with 2 threads, against one",
                    "two_sided_context/2/real_time",
                    "two_sided_context/1/real_time",
                    Row::Measure::speedup,
                    Row::Goal::at_least,
                    1.7};

}  // namespace
}  // namespace espalier::bench
