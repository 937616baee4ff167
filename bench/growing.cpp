#include "growing.h"

#include <cstring>
#include <string>
#include <vector>

namespace espalier::bench {

using namespace test;

namespace {

DerivationSettings settings_of(const Growing& growing) {
    DerivationSettings settings;
    settings.seed = 1;
    settings.lineage = growing.lineage;
    return settings;
}

template <class T>
void copy_column(const Column<T>& from, Column<T>& to) {
    to.resize(from.size());
    if (!from.empty()) std::memcpy(to.data(), from.data(), from.size() * sizeof(T));
}

void copy_columns(const ModuleString& from, ModuleString& to) {
    copy_column(from.letters, to.letters);
    copy_column(from.parameters, to.parameters);
    copy_column(from.births, to.births);
}

}  // namespace

void derive(benchmark::State& state, ModelBuilder& model, const Growing& growing) {
    const tbb::global_control control = threads(state);
    Derivation derivation(model.compiled(), settings_of(growing));
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

void copy(benchmark::State& state, ModelBuilder& model, const Growing& growing) {
    Derivation derivation(model.compiled(), settings_of(growing));
    std::vector<ModuleString> strings(std::size_t(growing.steps) + 1);
    std::int64_t each = 0;
    derivation.start(strings[0]);
    for (std::size_t k = 1; k < strings.size(); ++k) {
        derivation.step(strings[k - 1], strings[k]);
        each += static_cast<std::int64_t>(strings[k].size());
    }
    ModuleString copied;
    std::int64_t modules = 0;
    for (auto _ : state) {
        for (const ModuleString& string : strings) copy_columns(string, copied);
        benchmark::DoNotOptimize(copied.letters.data());
        modules += each;
    }
    state.SetItemsProcessed(modules);
}

void make_bare_plant(ModelBuilder& model) {
    model.system().axiom = model.word("X");
    model.rule("X", "F-[[X]+X]+F[+FX]-X");
    model.rule("F", "FF");
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

void make_bush(ModelBuilder& model, bool blocks) {
    model.system().axiom = {model.module("A", {number(1)})};
    const Expression s = formal(0), width = apply(Operator::power, {s, number(0.7)});
    const Expression angle = number(30) + call(Function::ran, {number(10)});
    const std::uint32_t w = blocks ? model.add_global("w") : 0, a = blocks ? model.add_global("a") : 0;
    Production& grows = model.rule(
        {{"A", 1}}, {model.module("!", {blocks ? global(w) : width}), model.module("F", {s}), model.module("[", {}),
                     model.module("+", {blocks ? global(a) : angle}),
                     model.module("A", {s * (number(0.6) + call(Function::ran, {number(0.2)}))}), model.module("]", {}),
                     model.module("/", {number(137.5)}), model.module("A", {s * number(0.9)})});
    grows.condition = number(0.002) < s;
    if (blocks) grows.after = {assign(global(w), width), assign(global(a), angle)};
    model.rule({{"A", 1}}, {model.module("L", {s})});
    model.rule({{"F", 1}}, {model.module("F", {s * number(1.05)})}).condition = s < number(100);
}

}  // namespace espalier::bench
