// Folders inside a timeline.
#pragma once

#include <filesystem>

namespace espalier {

/// Makes the folder and those above it, if they are missing. Throws RunError.
void make_folder(const std::filesystem::path& path);

}  // namespace espalier
