// How deep a TOML text nests, before toml++ reads it: each part of a key becomes a table within a table there, and
// whoever walks through too many of them, even to free them, runs out of stack. The limit of toml++ 3 is for values
// only.
#pragma once

#include "espalier/base/error.h"

#include <optional>
#include <string_view>

namespace espalier {

/// The most parts of a key, and the most tables and arrays that a value lies in.
constexpr int deepest_toml = 64;

/// Where the text first nests deeper, with lines and columns from 1 on and no name of a file; none if it does not. A
/// mistake in the text ends the search: toml++ reads no further, and says what it is.
std::optional<Place> deeper_than_toml_may_be(std::string_view text);

}  // namespace espalier
