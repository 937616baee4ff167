#include "espalier/lsystem/alphabet.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

namespace espalier::lsystem {
namespace {

constexpr std::size_t most_letters = 65'000;

}  // namespace

Alphabet::Alphabet() {
    letter("[", 0);
    letter("]", 0);
    letter("%", 0);
}

SymbolId Alphabet::symbol(std::string_view symbol) {
    const auto found = symbol_ids_.find(std::string(symbol));
    if (found != symbol_ids_.end()) return found->second;
    if (symbols_.size() >= most_letters) throw UserError(fmt::format("a model has at most {} symbols", most_letters));
    const auto id = static_cast<SymbolId>(symbols_.size());
    symbols_.emplace_back(symbol);
    symbol_ids_.emplace(symbols_.back(), id);
    return id;
}

LetterId Alphabet::letter(std::string_view symbol_name, int arity) {
    if (arity < 0 || arity > 0xFFFF) {
        throw UserError(fmt::format("'{}' has {} parameters; a module has at most 65535", symbol_name, arity));
    }
    const SymbolId id = symbol(symbol_name);
    const std::uint32_t key = (std::uint32_t{id} << 16) | static_cast<std::uint32_t>(arity);
    const auto found = letter_ids_.find(key);
    if (found != letter_ids_.end()) return found->second;
    if (size() >= most_letters) throw UserError(fmt::format("a model has at most {} letters", most_letters));
    const auto made = static_cast<LetterId>(size());
    arities_.push_back(static_cast<std::uint16_t>(arity));
    symbol_of_.push_back(id);
    letter_ids_.emplace(key, made);
    return made;
}

std::optional<SymbolId> Alphabet::find_symbol(std::string_view symbol) const {
    const auto found = symbol_ids_.find(std::string(symbol));
    if (found == symbol_ids_.end()) return std::nullopt;
    return found->second;
}

std::optional<LetterId> Alphabet::find(std::string_view symbol, int arity) const {
    const std::optional<SymbolId> id = find_symbol(symbol);
    if (!id || arity < 0 || arity > 0xFFFF) return std::nullopt;
    const auto found = letter_ids_.find((std::uint32_t{*id} << 16) | static_cast<std::uint32_t>(arity));
    if (found == letter_ids_.end()) return std::nullopt;
    return found->second;
}

}  // namespace espalier::lsystem
