// Labels of productions, as books have them and models do not.
#pragma once

#include <cstddef>
#include <string_view>

namespace espalier::language {

/// "p1", "p_12": what books put before a production and a ':'.
bool is_label(std::string_view text);

/// Length of a label that stands at the beginning of a production's text, with its ':'; 0 if there is none. That it is
/// one shows in a second ':' before the arrow: `p1: A(x) : x > 1 --> B`.
std::size_t label_length(std::string_view production);

}  // namespace espalier::language
