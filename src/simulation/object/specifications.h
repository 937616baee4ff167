// The file `specifications` of an object: which files belong to it, and a menu of commands.
#pragma once

#include "espalier/base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::simulation {

struct MenuCommand {
    std::vector<std::string> words;  ///< as a shell would split them
    Place place;
    std::string line;
};

struct Specifications {
    std::vector<std::string> files;
    std::vector<MenuCommand> commands;  ///< from top to bottom, whatever menus they stand in
    std::vector<Diagnostic> diagnostics;
};

/// Throws UserError if the file cannot be read or has no menu.
Specifications read_specifications(const std::filesystem::path& path);

}  // namespace espalier::simulation
