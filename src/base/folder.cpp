#include "base/folder.h"

#include "espalier/base/error.h"

#include "base/platform.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
namespace {

namespace fs = std::filesystem;

// weakly_canonical leaves a relative path relative if it does not exist.
fs::path resolved(const fs::path& path, std::error_code& error) {
    const fs::path whole = fs::absolute(path, error);
    return error ? whole : fs::weakly_canonical(whole, error);
}

// A link that leads to nothing is not resolved, but whoever writes there follows it.
bool has_dangling_link(const fs::path& whole) {
    std::error_code unknown;
    fs::path path;
    for (const fs::path& part : whole) {
        path /= part;
        if (fs::is_symlink(fs::symlink_status(path, unknown))) return true;
    }
    return false;
}

}  // namespace

void make_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
}

void make_folder_below(const fs::path& folder, const fs::path& below) {
    fs::path path = folder;
    for (const fs::path& part : below) {
        path /= part;
        std::error_code unknown;
        if (!fs::is_symlink(fs::symlink_status(path, unknown))) continue;
        throw RunError(
            fmt::format("{} is a link, which is not followed for writing: put a folder in its place, or write "
                        "into another folder",
                        path.string()));
    }
    make_folder(path);
}

void append_text(const fs::path& path, std::string_view text) {
    std::error_code error;
    platform::OpenFile file(path, platform::OpenFile::Mode::append, error);
    if (!error) error = file.write(text);
    if (!error) error = file.close();
    if (error) throw RunError(fmt::format("cannot write {}: {}", path.string(), reason_of(error)));
}

bool is_folder_itself(const fs::path& path) {
    std::error_code unknown;
    return fs::is_directory(fs::symlink_status(path, unknown));
}

std::uintmax_t bytes_below(const fs::path& folder) {
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator item(folder, error), end; !error && item != end; item.increment(error)) {
        std::error_code gone;
        if (!item->is_regular_file(gone)) continue;
        const std::uintmax_t size = item->file_size(gone);
        if (!gone) bytes += size;
    }
    return bytes;
}

std::string reason_of(const std::error_code& error) {
    if (error == std::errc::too_many_symbolic_link_levels) return "it is a link, which is not followed for writing";
    return error.message();
}

fs::path resolved_below(const fs::path& path, const fs::path& folder, std::error_code& error) {
    const fs::path root = resolved(folder, error);
    if (error) return {};
    const fs::path whole = resolved(path, error);
    const bool is_below = std::mismatch(root.begin(), root.end(), whole.begin(), whole.end()).first == root.end();
    return !error && is_below && !has_dangling_link(whole) ? whole : fs::path();
}

}  // namespace espalier
