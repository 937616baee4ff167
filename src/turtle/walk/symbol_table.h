// What the turtle does with each letter of a model, as tables indexed by letter.
#pragma once

#include "espalier/turtle/symbol.h"

#include <atomic>

namespace espalier::turtle {

/// What one letter means in one place. `level` is the table for the next module where that one may belong to the same
/// symbol (as after `@`), 0 if this letter ends its symbol.
struct LetterMeaning {
    SymbolAction action = nullptr;
    std::uint16_t arity = 0;
    std::uint16_t level = 0;
    bool belongs = false;  ///< in a level beyond the first: part of the symbol that began before
    Symbol::Effect effect = Symbol::Effect::other;
    Symbol::Step step = Symbol::Step::by_action;
};

/// A symbol found in a string: its last module, and what it does.
struct SymbolMatch {
    std::size_t module;
    LetterMeaning meaning;
};

class SymbolTable {
public:
    explicit SymbolTable(const Model& model);

    /// The longest symbol that begins at module i. Only its last module may have parameters.
    SymbolMatch match(const ModuleString& string, std::size_t i) const {
        SymbolMatch found{i, levels[0][string.letters[i]]};
        while (found.meaning.level && found.module + 1 < string.size()) {
            const LetterMeaning& next = levels[found.meaning.level][string.letters[found.module + 1]];
            if (!next.belongs) break;
            found = {found.module + 1, next};
        }
        return found;
    }

    /// levels[0] is for the first module of a symbol, the others for what follows certain beginnings.
    std::vector<std::vector<LetterMeaning>> levels;
    /// Index into Model::processes of letters such as ?light, -1 for all others.
    std::vector<std::int16_t> processes;
    /// Letters that a homomorphism production may begin with.
    std::vector<char> pictured;
    /// Pictures depend on modules around the one that is pictured.
    bool pictures_look_around = false;
    /// Set once a string of this model could not be walked by several threads: then all are walked in one piece.
    mutable std::atomic<bool> unpredictable = false;
    /// What was ignored in strings of this model so far, as bits of `Ignored`.
    mutable std::atomic<unsigned> ignored = 0;

private:
    std::uint16_t add_level(const Alphabet& alphabet, const std::string& beginning);
};

}  // namespace espalier::turtle
