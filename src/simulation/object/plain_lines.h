// Files of plain lines (.a, .e, specifications): no comments, nothing preprocessed.
#pragma once

#include "espalier/base/error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::simulation {

struct PlainLine {
    std::string text;  ///< without its line end, be it \n or \r\n
    Place place;       ///< place of its first character
};

/// `name` is the file's, for the places.
std::vector<PlainLine> plain_lines(std::string_view text, const std::string& name);

/// The number a word begins with, as atoi() reads it, within a thousand millions; nothing if it begins with none.
std::optional<int> leading_integer(std::string_view word);

}  // namespace espalier::simulation
