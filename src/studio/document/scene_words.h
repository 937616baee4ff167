// What the documentation of a scene's parts says of the numbers that a scene has.
#pragma once

#include "espalier/base/settings.h"

#include <string>

namespace espalier::studio {

/// The documentation of a table's keys: that of its process or stage, that of the scene's table of this name, or
/// `outer`, which is that of the table around it.
std::string help_of_table(const Settings& table, const std::string& name, const std::string& outer);

struct KeyWords {
    std::string meaning;  ///< a phrase or sentence; the key itself if nothing is said of it
    std::string unit;     ///< "" if none is said
};

/// What the row of the documentation that tells of the key says, or what is known of keys of tables within a row.
KeyWords words_of_key(const std::string& help, const std::string& key);

}  // namespace espalier::studio
