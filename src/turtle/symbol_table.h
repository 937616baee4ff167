// What the turtle does with each letter of a model, as tables indexed by letter.
#pragma once

#include "espalier/turtle/symbol.h"

namespace espalier {

/// What one letter means in one place. `level` is the table for the next module where that one may belong to the same
/// symbol (as after `@`), 0 if this letter ends its symbol.
struct LetterMeaning {
    SymbolAction action = nullptr;
    std::uint16_t arity = 0;
    std::uint16_t level = 0;
    bool belongs = false;  ///< in a level beyond the first: part of the symbol that began before
};

class SymbolTable {
public:
    explicit SymbolTable(const Model& model);

    /// levels[0] is for the first module of a symbol, the others for what follows certain beginnings.
    std::vector<std::vector<LetterMeaning>> levels;
    /// Index into Model::processes of letters such as ?light, -1 for all others.
    std::vector<std::int16_t> processes;

private:
    std::uint16_t add_level(const Alphabet& alphabet, const std::string& beginning);
};

}  // namespace espalier
