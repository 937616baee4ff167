// Where people keep what programs leave between their runs.
#pragma once

#include <filesystem>

namespace espalier {

/// Espalier's folder below that of the user (XDG base directory specification), which may not be there yet; empty if
/// the system does not say.
std::filesystem::path state_folder();

}  // namespace espalier
