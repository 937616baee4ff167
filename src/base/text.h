// Small things about text: the nearest known name, numbers as the C library prints them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// The candidate closest to `name` by edit distance, or "" if none is near enough to be a slip of the pen.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// " (did you mean 'x'?)" for the nearest candidate, or "".
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

/// A number as printf's %g writes it (6 significant digits): cpfg's notation for parameters.
std::string format_general(double value);

/// The shortest text that reads back as the same double.
std::string format_exact(double value);

/// Bytes of the character that begins at `i`, or 0 if it cannot be shown: a control character, or no UTF-8.
std::size_t shown_length(std::string_view text, std::size_t i);

/// The same text to be shown: control characters other than newline and tab, and bytes that are no UTF-8, as `\x1b`.
std::string escaped(std::string_view text);

/// Without the blanks at both ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");

/// A to Z as small letters; all other bytes stay.
std::string in_small_letters(std::string_view text);

/// The words between any of the separators; none of them is empty.
std::vector<std::string> words_of(std::string_view text, std::string_view separators);

/// Splits UTF-8 text into code points, each as its own string; invalid bytes stand for themselves.
std::vector<std::string> code_points(std::string_view text);

}  // namespace espalier
