// Folders, and what lies in them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace espalier {

/// Makes the folder and those above it, if they are missing. Throws RunError.
void make_folder(const std::filesystem::path& path);

/// Makes a folder that lies `below` another, and those between. Throws RunError, also if one of them is a link there:
/// what is written into a folder, which may be from elsewhere, stays in it.
void make_folder_below(const std::filesystem::path& folder, const std::filesystem::path& below);

/// Adds to the end of a file that is there. Throws RunError, also for a link, which is not followed.
void append_text(const std::filesystem::path& path, std::string_view text);

/// A folder itself, and no link to one.
bool is_folder_itself(const std::filesystem::path& path);

/// Of all files below a folder. Those that vanish meanwhile were temporary.
std::uintmax_t bytes_below(const std::filesystem::path& folder);

/// The system's reason, in words of our own where those mislead.
std::string reason_of(const std::error_code& error);

/// The path, which need not exist, with all links resolved, if it is the folder or below it; empty if it is not or
/// a link on the way leads to nothing, and, with the system's reason in `error`, if that cannot be known.
std::filesystem::path resolved_below(const std::filesystem::path& path, const std::filesystem::path& folder,
                                     std::error_code& error);

}  // namespace espalier
