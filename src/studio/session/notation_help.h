// The words of the languages that pages edit, with what they mean.
#pragma once

#include <nlohmann/json.hpp>

namespace espalier::studio {

/// By the name of a language, as `{name, summary, help}`: `cpfg` has its keywords, `sdl` the words of its blocks,
/// `species` its parameters with their units, ranges and defaults.
nlohmann::ordered_json words_json();

}  // namespace espalier::studio
