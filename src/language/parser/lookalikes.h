// Characters beyond ASCII that word processors and web pages put in place of those that a keyboard has.
#pragma once

#include <string>
#include <string_view>

namespace espalier::language {

/// What a text begins with, if it is such a character: "'−', a minus sign (U+2212): type '-'". Empty for all others.
std::string lookalike(std::string_view text);

}  // namespace espalier::language
