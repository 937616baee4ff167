// The code of an entity: "^<I12", "/P1/A1/U1<<U9".
#pragma once

#include "espalier/base/error.h"

#include <string_view>
#include <vector>

namespace espalier::language::mtg {

constexpr int longest_sequence = 100'000;

struct EntityCode {
    char relation;            ///< / is a part of, < follows, + is borne by
    std::string_view label;   ///< a class and an index
    bool is_row = false;      ///< << and ++: all from the one before to this one
    bool last_alone = false;  ///< <. and +.: the same, whose features are those of the last
};

/// Those of a code, without the ^ at its beginning. Throws UserError at the place.
std::vector<EntityCode> items_of(std::string_view code, const Place& place);

/// Where the index of a label begins.
std::size_t first_digit(std::string_view label);

}  // namespace espalier::language::mtg
