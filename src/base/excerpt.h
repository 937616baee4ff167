// The line of text a message speaks of, as it is shown below the message.
#pragma once

#include "espalier/base/error.h"

#include <string>

namespace espalier {

/// A text with '?' for what a terminal would obey instead of showing it: control characters, and what is no UTF-8.
std::string printable(std::string text);

/// A line break, the line, and a caret under the column (in bytes, 0 = none) on a line of its own.
/// Characters of several bytes are one wide; of a long line only the part about the column is shown.
std::string excerpt(const std::string& line, int column);

/// The same of the line at a place, read from its file; "" if it cannot be read.
std::string excerpt(const Place& place);

/// The line of text at a place, read from its file; "" if it cannot be read.
std::string source_line(const Place& place);

}  // namespace espalier
