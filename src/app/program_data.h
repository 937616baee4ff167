// Where the program lies, and the models and environments that come with it.
#pragma once

#include <filesystem>

namespace espalier::app {

/// The folder that holds the running program; empty if the system does not say.
std::filesystem::path program_folder();

/// The folder that holds `models` and `environments`: installed with this program, or the tree it was built in. Empty
/// if there is none.
std::filesystem::path program_data();

/// The file itself if it is there; else the one of that name that comes with the program, if there is one.
std::filesystem::path here_or_with_program(const std::filesystem::path& file);

}  // namespace espalier::app
