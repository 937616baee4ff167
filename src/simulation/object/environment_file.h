// Environment files (.e): which process answers ?E, and in which notation the questions reach it.
#pragma once

#include "espalier/base/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::simulation {

/// What an environment file makes of a scene.
struct EnvironmentFile {
    /// Processes with their [environment.<name>] tables; ?E asks the first, or the one that its first parameter counts
    /// from 0 if `routed`.
    std::vector<std::pair<std::string, Settings>> processes;
    bool routed = false;
    std::vector<std::filesystem::path> files;  ///< that were read or are named
    std::vector<Diagnostic> diagnostics;       ///< lines that are ignored
    std::vector<std::string> unused;           ///< what was read and has no meaning inside one program
};

/// Reads an environment file, and those it names if it is of process `multiple`. Files are looked for beside the one
/// that names them, then in `folder`. Throws UserError if nothing here answers under the name it gives.
EnvironmentFile read_environment_file(const std::filesystem::path& path, const std::filesystem::path& folder = {});

}  // namespace espalier::simulation
