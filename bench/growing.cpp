#include "growing.h"

#include <string>

namespace espalier::bench {

using namespace test;

void derive(benchmark::State& state, ModelBuilder& model, const Growing& growing) {
    const tbb::global_control control = threads(state);
    DerivationSettings settings;
    settings.seed = 1;
    settings.lineage = growing.lineage;
    Derivation derivation(model.compiled(), settings);
    ModuleString string, next;
    std::int64_t modules = 0;
    for (auto _ : state) {
        derivation.start(string);
        for (int k = 0; k < growing.steps; ++k) {
            if (growing.counts == Counts::visits) modules += static_cast<std::int64_t>(string.size());
            derivation.step(string, next);
            std::swap(string, next);
            if (growing.counts == Counts::written) modules += static_cast<std::int64_t>(string.size());
        }
        benchmark::DoNotOptimize(string.letters.data());
    }
    state.SetItemsProcessed(modules);
}

void make_honda(ModelBuilder& model) {
    constexpr double r1 = 0.9, r2 = 0.6, wr = 0.707;
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

}  // namespace espalier::bench
