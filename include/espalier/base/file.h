// Files that appear complete or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace espalier {

/// Throws UserError naming the file unless it is a regular file (no device, pipe or socket, which may never end) of at
/// most 4 GiB that this thread has the permission to read (ReadPermission).
void require_readable(const std::filesystem::path& path);
/// Whether `require_readable` finds nothing wrong.
bool is_readable(const std::filesystem::path& path);

/// The whole file as text. Throws UserError naming the file if it cannot be read, as `require_readable` does.
std::string read_text(const std::filesystem::path& path);

/// Writes beside `path` and renames, so that `path` is either the old file or the whole new one.
/// Throws RunError with the system's reason (disk full, read-only, ...) and removes what it wrote.
void write_text(const std::filesystem::path& path, std::string_view text);
/// The same for a text that lies in memory piece by piece.
void write_text(const std::filesystem::path& path, std::span<const std::string_view> parts);

/// The same as a file that only its owner may read.
void write_private_text(const std::filesystem::path& path, std::string_view text);

/// For writers that want a file name of their own: calls `write(temporary)` and renames the result to `path`.
/// The temporary name keeps the extension. `write` returns false or throws on failure. Throws RunError.
void write_file(const std::filesystem::path& path, const std::function<bool(const std::filesystem::path&)>& write);

/// A folder's lock: two runs into one folder are refused. Released when destroyed, also by a killed process.
class FolderLock {
public:
    /// Creates the folder if need be. Throws UserError if another process holds it, RunError if it cannot be written.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_ = -1;
};

/// True while a process holds a folder's lock, and where that cannot be known.
bool is_locked(const std::filesystem::path& folder);

}  // namespace espalier
