// The words that begin the lines of a model.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace espalier::language {

/// Length of the keyword at the beginning of `text`, or 0: each word's initial in either case, blanks between its words
/// optional.
std::size_t keyword_length(std::string_view text, std::string_view keyword);
/// Items of the header, longer ones before those they begin with.
std::span<const std::string> header_keywords();
/// Lines that stand after the axiom.
std::span<const std::string> section_keywords();
/// Whether a line is one of the language's own rather than a production or the rest of one.
bool begins_with_keyword(std::string_view line);
/// The same for a line that was probably meant to be one: words only, near a keyword.
bool resembles_keyword(std::string_view line);
/// A line that no block can hold, such as "axiom: ..." or "endlsystem".
bool fits_no_block(std::string_view line);

}  // namespace espalier::language
