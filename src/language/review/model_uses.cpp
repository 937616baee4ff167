#include "language/review/model_uses.h"

#include "language/parser/constant.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace espalier::language {

ModelUses::ModelUses(const Model& model, const std::set<LetterId>& inserted)
    : model_(model), produced_(inserted), reached_(inserted) {
    for (const LSystem& system : model_.systems) collect(system);
    reach();
    for (const LSystem& system : model_.systems) {
        for_each_production(system, [&](const Production& production) { has_words_ |= is_word(production); });
    }
}

void ModelUses::collect(const LSystem& system) {
    for (const ModuleTemplate& module : system.axiom) {
        produced_.insert(module.letter);
        collect_call(module);
    }
    for_each_production(system, [&](const Production& production) {
        for (const ModuleTemplate& module : production.successor) {
            produced_.insert(module.letter);
            collect_call(module);
        }
        for (const auto* part : {&production.left, &production.strict, &production.right}) {
            for (const ModulePattern& pattern : *part) {
                if (pattern.skip_branch) continue;
                mentioned_.insert(model_.alphabet.symbol_of(pattern.letter));
                matched_.insert(pattern.letter);
            }
        }
        for (const ModulePattern& pattern : production.strict) rewritten_.insert(pattern.letter);
    });
    mentioned_.insert(system.filtered.begin(), system.filtered.end());
}

void ModelUses::reach() {
    for (const LSystem& system : model_.systems) {
        for (const ModuleTemplate& module : system.axiom) reached_.insert(module.letter);
    }
    for (std::size_t before = 0; before != reached_.size();) {
        before = reached_.size();
        for (const LSystem& system : model_.systems) {
            for_each_production(system, [&](const Production& production) {
                const auto is_reached = [&](const ModulePattern& pattern) { return reached_.contains(pattern.letter); };
                if (!std::all_of(production.strict.begin(), production.strict.end(), is_reached)) return;
                for (const ModuleTemplate& module : production.successor) reached_.insert(module.letter);
            });
        }
    }
}

// ?(id) and ?(id, scale) call an L-system of the file.
void ModelUses::collect_call(const ModuleTemplate& module) {
    const int arity = alphabet().arity(module.letter);
    if (alphabet().name(module.letter) != "?" || (arity != 1 && arity != 2)) return;
    const std::optional<double> id = constant_value(module.arguments.front());
    if (id) {
        called_.emplace(fmt::format("{}", *id), module.place);
    } else {
        calls_any_ = true;
    }
}

bool ModelUses::is_produced(SymbolId symbol) const {
    return std::any_of(produced_.begin(), produced_.end(),
                       [&](LetterId letter) { return alphabet().symbol_of(letter) == symbol; });
}

std::set<int> ModelUses::rewritten_arities(SymbolId symbol) const {
    std::set<int> arities;
    for (const LetterId letter : rewritten_) {
        if (alphabet().symbol_of(letter) == symbol) arities.insert(alphabet().arity(letter));
    }
    return arities;
}

bool ModelUses::is_word(const Production& production) const {
    const std::size_t length = word_length(production.strict, 0);
    return length > 0 && length == production.strict.size();
}

std::string ModelUses::described(LetterId letter) const {
    const int arity = alphabet().arity(letter);
    const std::string& name = alphabet().name(letter);
    return arity == 0 ? fmt::format("'{}'", name) : fmt::format("'{}' {}", name, with_parameters(arity));
}

std::string with_parameters(int arity) {
    if (arity == 0) return "without parameters";
    return fmt::format("with {} parameter{}", arity, arity == 1 ? "" : "s");
}

}  // namespace espalier::language
