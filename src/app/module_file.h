// Where the modules of the program lie, which it opens when they are needed.
#pragma once

#include <filesystem>
#include <string>

namespace espalier::app {

/// Beside the program in a build folder, in the folder of libraries once installed; empty if it is in neither.
std::filesystem::path module_file(const std::string& name);

}  // namespace espalier::app
