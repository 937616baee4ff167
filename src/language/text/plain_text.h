// What bytes must be to be read as text, and the marks that editors add to it.
#pragma once

#include <string>

namespace espalier::language {

/// Throws UserError if a text is none, so that its bytes are not reported one by one.
void require_text(const std::string& text, const std::string& name);

/// The text with line feeds for every way to end a line, and without the mark of UTF-8 at its beginning.
std::string with_plain_lines(std::string text);

}  // namespace espalier::language
