// The programs that the files of a scene would start, and the folders that the user trusts to name programs.
#pragma once

#include "espalier/base/error.h"
#include "espalier/simulation/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::simulation {

/// What a process `external` starts.
struct NamedProgram {
    std::string process;               ///< its name in the scene
    std::vector<std::string> command;  ///< the program and its arguments
    Place place;                       ///< where it is named
    std::filesystem::path folder;      ///< of the file that names it: absolute, without links
};

std::vector<NamedProgram> programs_of(const Scene& scene);

/// The same file or folder whatever leads there: absolute, without links.
std::filesystem::path resolved(const std::filesystem::path& path);

/// Is the user known to have agreed that files of the folder start programs? Folders below it are others.
bool is_trusted(const std::filesystem::path& folder);
/// Remembers it, in a file of the user's state folder. Throws RunError if that cannot be written.
void remember_trust(const std::filesystem::path& folder);

}  // namespace espalier::simulation
