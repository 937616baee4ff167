// The letters of a model. A module matches on its symbol and its number of parameters, so the two together
// are one letter: F, F(l) and F(l, w) are three letters of the symbol F.
#pragma once

#include "espalier/base/stations.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace espalier::lsystem {

using LetterId = std::uint16_t;
using SymbolId = std::uint16_t;

/// Stands for "no letter", as after the last module of a string.
inline constexpr LetterId no_letter = 0xFFFF;

/// Letters and symbols, numbered in order of first mention. Brackets are always letters 0 and 1, the cut `%` letter 2.
class Alphabet {
public:
    static constexpr LetterId open_bracket = 0;
    static constexpr LetterId close_bracket = 1;
    static constexpr LetterId cut = 2;

    Alphabet();

    /// The letter for a symbol (one Unicode code point, or a declared name such as "Apex" or "?light") and arity,
    /// made if new. Throws UserError beyond 65,000 letters.
    LetterId letter(std::string_view symbol, int arity);
    std::optional<LetterId> find(std::string_view symbol, int arity) const;
    std::optional<SymbolId> find_symbol(std::string_view symbol) const;
    SymbolId symbol(std::string_view symbol);

    std::size_t size() const { return arities_.size(); }
    std::size_t symbol_count() const { return symbols_.size(); }
    int arity(LetterId letter) const { return arities_[letter]; }
    SymbolId symbol_of(LetterId letter) const { return symbol_of_[letter]; }
    const std::string& name(LetterId letter) const { return symbols_[symbol_of_[letter]]; }
    const std::string& symbol_name(SymbolId symbol) const { return symbols_[symbol]; }
    /// Arity of every letter, indexed by letter: the table the hot loops read.
    std::span<const std::uint16_t> arities() const { return arities_; }

private:
    std::vector<std::string> symbols_;
    std::unordered_map<std::string, SymbolId> symbol_ids_;
    std::vector<std::uint16_t> arities_;
    std::vector<SymbolId> symbol_of_;
    std::unordered_map<std::uint32_t, LetterId> letter_ids_;  // symbol * 65536 + arity
};

}  // namespace espalier::lsystem
