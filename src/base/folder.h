// Folders, and what lies in them.
#pragma once

#include <filesystem>
#include <system_error>

namespace espalier {

/// Makes the folder and those above it, if they are missing. Throws RunError.
void make_folder(const std::filesystem::path& path);

/// The path, which need not exist, with all links resolved, if it is the folder or below it; empty if it is not, and,
/// with the system's reason in `error`, if that cannot be known.
std::filesystem::path resolved_below(const std::filesystem::path& path, const std::filesystem::path& folder,
                                     std::error_code& error);

}  // namespace espalier
