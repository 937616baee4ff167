// Numbers that a whole text is.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace espalier {

/// The number that `text` is from its first to its last character: without blanks, without '+', whatever the locale.
/// None if it is no number, or one that the type does not hold.
template <class Number>
std::optional<Number> whole_text_as(std::string_view text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && behind == end ? std::optional(number) : std::nullopt;
}

/// The same for real numbers, of which infinities and NaN are none.
inline std::optional<double> finite_number(std::string_view text) {
    const std::optional<double> number = whole_text_as<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace espalier
