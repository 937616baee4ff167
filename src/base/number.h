// Numbers that a whole text is.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace espalier {

/// The real number at the beginning of a text, as std::from_chars reads it; slower.
std::from_chars_result read_real(const char* begin, const char* end, double& number);

/// std::from_chars, of which libc++ before version 20 has whole numbers alone.
template <class Number>
std::from_chars_result read_number(const char* begin, const char* end, Number& number) {
    if constexpr (requires { std::from_chars(begin, end, number); }) {
        return std::from_chars(begin, end, number);
    } else {
        return read_real(begin, end, number);
    }
}

/// The number that `text` is from its first to its last character: without blanks, without '+', whatever the locale.
/// None if it is no number, or one that the type does not hold.
template <class Number>
std::optional<Number> whole_text_as(std::string_view text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [behind, error] = read_number(text.data(), end, number);
    return error == std::errc() && behind == end ? std::optional(number) : std::nullopt;
}

/// The same for real numbers, of which infinities and NaN are none.
inline std::optional<double> finite_number(std::string_view text) {
    const std::optional<double> number = whole_text_as<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace espalier
