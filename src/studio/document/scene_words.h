// What the documentation of a scene's parts says of the numbers that a scene has.
#pragma once

#include "espalier/base/settings.h"

#include <string>

namespace espalier::studio {

/// The documentation of a table's keys: that of its process or stage, that of the scene's table of this name, or
/// `outer`, which is that of the table around it.
std::string help_of_table(const Settings& table, const std::string& name, const std::string& outer);

/// "q_max, 6; number of layers below", if a row of the documentation begins with the key or it is one of those that
/// tables within a row have; else the key.
std::string words_of_key(const std::string& help, const std::string& key);

}  // namespace espalier::studio
