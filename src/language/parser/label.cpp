#include "language/parser/label.h"

#include "base/characters.h"

#include <algorithm>

namespace espalier::language {
namespace {

/// Length of a label that a text begins with, 0 if there is none.
std::size_t length_of_label(std::string_view text) {
    constexpr std::size_t longest_name = 2;
    const auto count_from = [&](std::size_t begin, std::string_view characters) {
        return std::min(text.find_first_not_of(characters, begin), text.size()) - begin;
    };
    const std::size_t letters = count_from(0, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    if (letters == 0 || letters > longest_name) return 0;
    const std::size_t number = letters + (text.substr(letters).starts_with('_') ? 1 : 0);
    const std::size_t digits = count_from(number, "0123456789");
    return digits > 0 ? number + digits : 0;
}

/// True if a ':' stands before the arrow, outside of parentheses and braces, and not that of `a ? b : c`.
bool has_condition(std::string_view production) {
    int open = 0;
    for (std::size_t i = 0; i < production.size(); ++i) {
        const char c = production[i];
        if (c == '?' && open == 0 && !(i + 1 < production.size() && is_name_start(production[i + 1]))) return false;
        if (c == '-' && (production.substr(i).starts_with("-->") || production.substr(i).starts_with("-o>"))) break;
        if (c == ':' && open == 0) return true;
        open += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
    }
    return false;
}

}  // namespace

bool is_label(std::string_view text) {
    return !text.empty() && length_of_label(text) == text.size();
}

std::size_t label_length(std::string_view production) {
    std::size_t colon = length_of_label(production);
    if (colon == 0) return 0;
    while (colon < production.size() && is_blank(production[colon])) ++colon;
    const bool is_label = production.substr(colon).starts_with(':') && has_condition(production.substr(colon + 1));
    return is_label ? colon + 1 : 0;
}

}  // namespace espalier::language
