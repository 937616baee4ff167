// L-systems as wholes: contexts, pictures, processes and calls.
#include "language/parser/constant.h"
#include "language/review/parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language {
namespace {

/// The right context stands directly behind the predecessor wherever that is written, as ?E(x) behind its apex.
bool is_followed(const Production& production, const Model& model) {
    const LetterId predecessor = production.strict.back().letter;
    const auto follows = [&](const std::vector<ModuleTemplate>& modules, std::size_t i) {
        return i + production.right.size() < modules.size() &&
               std::equal(production.right.begin(), production.right.end(),
                          modules.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                          [](const ModulePattern& pattern, const ModuleTemplate& module) {
                              return !pattern.skip_branch && pattern.letter == module.letter;
                          });
    };
    bool all = true;
    const auto look_at = [&](const std::vector<ModuleTemplate>& modules) {
        for (std::size_t i = 0; i < modules.size(); ++i) all &= modules[i].letter != predecessor || follows(modules, i);
    };
    for (const LSystem& system : model.systems) {
        look_at(system.axiom);
        for (const Production& each : system.productions) look_at(each.successor);
        for (const Production& each : system.decomposition.productions) look_at(each.successor);
    }
    return all;
}

bool reaches_itself(const std::map<LetterId, std::set<LetterId>>& pictures, LetterId start) {
    std::set<LetterId> seen;
    std::vector<LetterId> waiting{start};
    while (!waiting.empty()) {
        const auto next = pictures.find(waiting.back());
        waiting.pop_back();
        if (next == pictures.end()) continue;
        for (const LetterId letter : next->second) {
            if (letter == start) return true;
            if (seen.insert(letter).second) waiting.push_back(letter);
        }
    }
    return false;
}

}  // namespace

void review_filter(const LSystem& system, const ModelUses& uses, Findings& findings) {
    if (system.filter != LSystem::Filter::consider) return;
    const auto considered = [&](LetterId letter) {
        return std::find(system.filtered.begin(), system.filtered.end(), uses.alphabet().symbol_of(letter)) !=
               system.filtered.end();
    };
    if (considered(Alphabet::open_bracket) && considered(Alphabet::close_bracket)) return;
    const Production* first = nullptr;
    for_each_production(system, [&](const Production& production) {
        if (!first && !production.right.empty() && !is_followed(production, uses.model())) first = &production;
    });
    if (first) {
        findings.warn(first->place,
                      "'consider' does not name the brackets, so that this right context looks into branches as if "
                      "they were the axis: write 'consider: ...[]'");
    }
}

void review_homomorphism(const RuleSet& rules, const ModelUses& uses, Findings& findings) {
    if (!rules.maximum_depth) return;  // depth 1: nothing is replaced twice
    const std::optional<double> depth = constant_value(*rules.maximum_depth);
    if (depth && *depth <= 1) return;
    std::map<LetterId, std::set<LetterId>> pictures;
    for (const Production& production : rules.productions) {
        if (production.condition) continue;  // which may end it
        for (const ModuleTemplate& module : production.successor) {
            pictures[production.strict.front().letter].insert(module.letter);
        }
    }
    for (const Production& production : rules.productions) {
        if (production.condition || !reaches_itself(pictures, production.strict.front().letter)) continue;
        findings.warn(production.place,
                      fmt::format("the picture of {} contains itself; it ends at the maximum depth only",
                                  uses.described(production.strict.front().letter)));
        return;
    }
}

void review_processes(const ModelUses& uses, Findings& findings) {
    for (const std::string& name : uses.model().processes) {
        const std::optional<SymbolId> symbol = uses.alphabet().find_symbol("?" + name);
        const bool asked = symbol && uses.is_produced(*symbol);
        if (!asked)
            findings.warn({}, fmt::format("'environment {0};' is declared, but no module '?{0}' asks it", name));
    }
}

void review_calls(const ModelUses& uses, Findings& findings) {
    std::set<std::string> labels;
    for (const LSystem& system : uses.model().systems) labels.insert(system.label);
    for (const auto& [label, place] : uses.called()) {
        if (!labels.contains(label))
            findings.warn(place, fmt::format("no L-system of this file has the label {}", label));
    }
    for (std::size_t i = 1; i < uses.model().systems.size() && !uses.calls_any(); ++i) {
        const LSystem& system = uses.model().systems[i];
        if (uses.called().contains(system.label)) continue;
        const Place place = system.productions.empty() ? Place{} : system.productions.front().place;
        findings.warn(place,
                      fmt::format("the L-system with the label {0} is never called: ?({0}) ... $", system.label));
    }
}

}  // namespace espalier::language
