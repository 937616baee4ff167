// Marks in a text that a translator puts together: each part keeps the place where it was written, however it is
// formatted, joined, and its names replaced. A mark is made of control characters, digits and points.
#pragma once

#include "espalier/language/notation.h"

#include "language/text/source.h"

#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// The text as one that was written at a place. Parts of it may have places of their own.
std::string marked(std::string_view text, Location at);

std::string without_marks(std::string_view text);

/// The text without its marks, and what they say; `files` are the names of the files by number.
TranslatedText unmarked(std::string_view text, const std::vector<std::string>& files);

}  // namespace espalier::language
