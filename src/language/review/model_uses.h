// What a model does with its symbols, as its review asks: what it produces, names, calls and spells.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace espalier::language {

template <class Visit>
void for_each_production(const LSystem& system, Visit&& visit) {
    for (const Production& production : system.productions) visit(production);
    for (const Production& production : system.decomposition.productions) visit(production);
    for (const Production& production : system.homomorphism.productions) visit(production);
}

class ModelUses {
public:
    ModelUses(const Model& model, const std::set<LetterId>& inserted);

    const Model& model() const { return model_; }
    const Alphabet& alphabet() const { return model_.alphabet; }

    /// Letters of the axioms, of successors, and of what is inserted.
    const std::set<LetterId>& produced() const { return produced_; }
    /// Those of them that some axiom leads to.
    const std::set<LetterId>& reached() const { return reached_; }
    bool is_produced(SymbolId symbol) const;
    /// Does a predecessor or a context name it with this number of parameters?
    bool is_matched(LetterId letter) const { return matched_.contains(letter); }
    /// The numbers of parameters with which predecessors name it.
    std::set<int> rewritten_arities(SymbolId symbol) const;
    /// Does a predecessor, a context, or a list of ignored modules name it?
    bool is_mentioned(SymbolId symbol) const { return mentioned_.contains(symbol); }

    /// The labels of called L-systems, and where they are called.
    const std::map<std::string, Place>& called() const { return called_; }
    /// Is a label computed?
    bool calls_any() const { return calls_any_; }

    /// How many modules from `i` on spell a word such as Apex, of which only the last has parameters; 0: no word.
    template <class Modules>
    std::size_t word_length(const Modules& modules, std::size_t i) const {
        std::size_t length = 0;
        while (i + length < modules.size()) {
            const LetterId letter = modules[i + length].letter;
            const std::string& name = alphabet().name(letter);
            const char first = length == 0 ? 'A' : 'a';
            if (name.size() != 1 || name[0] < first || name[0] > first + 25) break;
            ++length;
            if (alphabet().arity(letter) > 0) break;
        }
        return length >= shortest_word ? length : 0;
    }
    /// Does the production replace a word that is not declared?
    bool is_word(const Production& production) const;
    /// Does any?
    bool has_words() const { return has_words_; }

    /// "'A' with 2 parameters"
    std::string described(LetterId letter) const;

private:
    void collect(const LSystem& system);
    void collect_call(const ModuleTemplate& module);
    void reach();

    static constexpr std::size_t shortest_word = 3;

    const Model& model_;
    std::set<LetterId> produced_, reached_, matched_, rewritten_;
    std::set<SymbolId> mentioned_;
    std::map<std::string, Place> called_;
    bool calls_any_ = false;
    bool has_words_ = false;
};

/// "without parameters", "with 2 parameters"
std::string with_parameters(int arity);

}  // namespace espalier::language
