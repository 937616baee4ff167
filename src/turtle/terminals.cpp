#include "turtle/terminals.h"

#include "turtle/walk/symbol_table.h"

namespace espalier::turtle {

ModuleString terminals_of(const Model& model, const SymbolTable& symbols, const ModuleString& string) {
    ModuleString terminals;
    const double* values = string.parameters.data();
    const auto take = [&](std::size_t module, bool keep) {
        const LetterId letter = string.letters[module];
        const auto arity = static_cast<std::size_t>(model.alphabet.arity(letter));
        if (keep) terminals.append(letter, {values, arity});
        values += arity;
    };
    for (std::size_t i = 0; i < string.size(); ++i) {
        const LetterId letter = string.letters[i];
        const SymbolMatch found = symbols.match(string, i);
        const bool drawn = found.meaning.action || symbols.pictured[letter] || letter == Alphabet::open_bracket ||
                           letter == Alphabet::close_bracket;
        for (const std::size_t last = drawn ? found.module : i; i < last; ++i) take(i, drawn);
        take(i, drawn);
    }
    return terminals;
}

}  // namespace espalier::turtle
