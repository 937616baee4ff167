// Files that end with a digest of their bytes: what was damaged since is not taken for what was written.
#pragma once

#include <filesystem>

namespace espalier::simulation {

/// Appends the digest; false if the file cannot be read or written.
bool seal(const std::filesystem::path& path);
/// False for a file that was never sealed, or is another since.
bool is_sealed(const std::filesystem::path& path);

}  // namespace espalier::simulation
