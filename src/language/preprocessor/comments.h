// First step of preprocessing: joins lines ended by a backslash and removes comments.
#pragma once

#include "language/text/source.h"

namespace espalier::language {

/// Each comment becomes one blank; inside quotes that close on their line there are no comments.
MappedText without_comments(const Sources& sources, std::uint32_t file, Mistakes& mistakes);

/// The end of the literal that begins with the quote at `start`, or `start` if its line ends before it closes.
std::size_t end_of_literal(std::string_view text, std::size_t start);

}  // namespace espalier::language
