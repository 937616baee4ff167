#include "turtle/asking.h"

namespace espalier::turtle {

bool has_queries(const Alphabet& alphabet) {
    for (std::size_t symbol = 0; symbol < alphabet.symbol_count(); ++symbol) {
        if (alphabet.symbol_name(static_cast<SymbolId>(symbol)).starts_with('?')) return true;
    }
    return alphabet.find("s", 2) || alphabet.find("s", 3);  // the older name of ?P
}

}  // namespace espalier::turtle
