// What is wrong with a line that is no TOML, in the user's words instead of the parser's.
#pragma once

#include <string>
#include <string_view>

namespace espalier {

/// `complaint`: what toml++ says of the line.
std::string words_for_toml(std::string_view complaint, std::string_view line);

}  // namespace espalier
