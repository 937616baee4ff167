#include "turtle/walk/symbol_table.h"

#include "base/text.h"

#include <algorithm>
#include <utility>

namespace espalier::turtle {
namespace {

const Symbol* find_symbol(const std::string& name) {
    const auto found = registered<Symbol>().find(name);
    return found == registered<Symbol>().end() ? nullptr : found->second;
}

/// True if a longer symbol begins like this.
bool begins_symbol(const std::string& beginning) {
    const auto next = registered<Symbol>().upper_bound(beginning);
    return next != registered<Symbol>().end() && next->first.starts_with(beginning);
}

/// A question without parameters is none.
Symbol::Effect effect_of(const Symbol& symbol, int arity) {
    return symbol.effect == Symbol::Effect::asks && arity == 0 ? Symbol::Effect::other : symbol.effect;
}

/// A width without parameter changes by the increment.
Symbol::Step step_of(const Symbol* symbol, const LetterMeaning& meaning) {
    using enum Symbol::Step;
    if (meaning.level) return by_action;
    if (!meaning.action) return none;
    return symbol->step == width && meaning.arity == 0 ? by_action : symbol->step;
}

}  // namespace

bool Symbol::accepts(int arity) const {
    return arities.empty() || std::find(arities.begin(), arities.end(), arity) != arities.end();
}

std::map<std::string, std::vector<int>, std::less<>> symbol_arities() {
    std::map<std::string, std::vector<int>, std::less<>> arities;
    for (const auto& [name, symbol] : registered<Symbol>()) arities[name] = symbol->arities;
    return arities;
}

SymbolTable::SymbolTable(const Model& model) : processes(model.alphabet.size(), -1), pictured(model.alphabet.size()) {
    add_level(model.alphabet, "");

    for (const LSystem& system : model.systems) {
        for (const Production& production : system.homomorphism.productions) {
            if (!production.strict.empty()) pictured[production.strict[0].letter] = true;
            pictures_look_around |= !production.left.empty() || !production.right.empty();
        }
    }

    // ?light is a letter of its own; it asks the process of that name as ?E asks the default one.
    const Symbol* communication = find_symbol("?E");
    for (std::size_t letter = 0; letter < model.alphabet.size(); ++letter) {
        const std::string& name = model.alphabet.name(LetterId(letter));
        if (name.size() < 2 || name[0] != '?') continue;
        const auto process = std::find(model.processes.begin(), model.processes.end(), name.substr(1));
        if (process == model.processes.end()) continue;
        processes[letter] = std::int16_t(process - model.processes.begin());
        levels[0][letter].action = communication->action;
        levels[0][letter].step = Symbol::Step::by_action;
        levels[0][letter].effect = effect_of(*communication, levels[0][letter].arity);
    }
}

std::uint16_t SymbolTable::add_level(const Alphabet& alphabet, const std::string& beginning) {
    const auto index = std::uint16_t(levels.size());
    levels.emplace_back(alphabet.size());
    const Symbol* any = beginning.empty() ? nullptr : find_symbol(beginning + "*");
    for (std::size_t letter = 0; letter < alphabet.size(); ++letter) {
        const std::string name = beginning + alphabet.name(LetterId(letter));
        const int arity = alphabet.arity(LetterId(letter));
        const Symbol* symbol = find_symbol(name);
        // Brackets and declared names keep their meaning whatever stands before them.
        const bool plain = letter > Alphabet::close_bracket && code_points(alphabet.name(LetterId(letter))).size() == 1;
        if (!symbol && any && plain) symbol = any;

        LetterMeaning meaning;
        meaning.arity = std::uint16_t(arity);
        if (symbol && symbol->accepts(arity)) {
            meaning.action = symbol->action;
            meaning.effect = effect_of(*symbol, arity);
        }
        if (arity == 0 && begins_symbol(name)) meaning.level = add_level(alphabet, name);
        meaning.step = step_of(symbol, meaning);
        meaning.belongs = symbol || meaning.level;
        levels[index][letter] = meaning;
    }
    return index;
}

std::shared_ptr<const SymbolTable> symbol_table(const Model& model) {
    return std::make_shared<SymbolTable>(model);
}

}  // namespace espalier::turtle
