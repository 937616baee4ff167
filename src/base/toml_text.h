// Texts in TOML files.
#pragma once

#include <string>

namespace espalier {

/// A text as TOML writes it, in quotes.
std::string toml_text(const std::string& text);

}  // namespace espalier
