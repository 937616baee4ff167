// Files that other files name.
#pragma once

#include "espalier/base/error.h"

#include <filesystem>
#include <string>

namespace espalier::simulation {

/// The file called `name` beside the one that names it, or else in `folder`. Throws UserError if it is in neither.
std::filesystem::path named_file(const std::string& name, const std::filesystem::path& beside,
                                 const std::filesystem::path& folder, const Place& place);

}  // namespace espalier::simulation
