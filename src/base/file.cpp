#include "espalier/base/file.h"

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"

#include "base/folder.h"
#include "base/platform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace espalier {
namespace {

namespace fs = std::filesystem;
using platform::OpenFile;

std::string reason(int error) {
    return std::generic_category().message(error);
}

[[noreturn]] void fail_to_write(const fs::path& path, const std::string& why) {
    throw RunError(fmt::format("cannot write {}: {}", path.string(), why));
}

fs::path temporary_beside(const fs::path& path) {
    // Hidden, of this process, with the extension writers go by.
    return path.parent_path() /
           fmt::format(".{}.{}.part{}", path.stem().string(), platform::process_number(), path.extension().string());
}

// Why a writer may have failed without saying so.
std::string likely_reason(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) return "the folder " + folder.string() + " is missing";
    if (const std::error_code denied = platform::denied(folder, platform::Access::write)) return denied.message();
    const fs::space_info space = fs::space(folder, error);
    if (!error && space.available < (1u << 20)) return "the disk is full";
    return "the writer failed (disk full or file too large?)";
}

constexpr std::uintmax_t most_bytes = std::uintmax_t{4} << 30;

bool is_permitted(const fs::path& path, const ReadPermission& permission) {
    std::error_code unknown;
    return std::any_of(permission.folders.begin(), permission.folders.end(),
                       [&](const fs::path& folder) { return !resolved_below(path, folder, unknown).empty(); });
}

std::string folders_text(const ReadPermission& permission) {
    std::string text;
    for (const fs::path& folder : permission.folders) text += (text.empty() ? "" : " and ") + folder.string();
    return text;
}

/// Why the file must not be read; empty if it may be. That of a missing file is the system's.
std::string reason_not_to_read(const fs::path& path) {
    if (path.empty()) return reason(ENOENT);
    if (path.native().find('\0') != std::string::npos) return "its name holds a zero byte";
    const ReadPermission* const permission = ReadLog::permission();
    if (permission && !is_permitted(path, *permission)) {
        return "what is open reads only files below " + folders_text(*permission);
    }
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return reason(ENOENT);
    if (error) return error.message();
    if (fs::is_directory(status)) return "it is a folder";
    if (!fs::is_regular_file(status)) return "it is a device, a pipe or a socket and no regular file";
    const std::uintmax_t size = fs::file_size(path, error), most = permission ? permission->most_bytes : most_bytes;
    return size > most ? fmt::format("it has {} bytes, and the most that is read is {}", size, most) : "";
}

void write_parts(const fs::path& path, std::span<const std::string_view> parts, OpenFile::Mode mode) {
    write_file(path, [&](const fs::path& temporary) {
        std::error_code error;
        OpenFile file(temporary, mode, error);
        if (!error) error = file.write(parts);
        if (!error) error = file.close();
        if (error) throw std::system_error(error);
        return true;
    });
}

}  // namespace

void require_readable(const fs::path& path) {
    const std::string why = reason_not_to_read(path);
    if (!why.empty()) throw UserError(fmt::format("cannot read {}: {}", path.string(), why));
}

bool is_readable(const fs::path& path) {
    return reason_not_to_read(path).empty();
}

std::string read_text(const fs::path& path) {
    require_readable(path);
    if (std::optional<std::string> unsaved = ReadLog::unsaved(path)) {
        ReadLog::note(path, *unsaved);
        return *std::move(unsaved);
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) throw UserError(fmt::format("cannot read {}: {}", path.string(), reason(errno)));
    std::ostringstream text;
    text << in.rdbuf();
    if (in.bad()) throw UserError(fmt::format("cannot read {}: {}", path.string(), reason(errno)));
    std::string bytes = std::move(text).str();
    ReadLog::note(path, bytes);
    return bytes;
}

void write_text(const fs::path& path, std::string_view text) {
    write_text(path, std::span(&text, 1));
}

void write_text(const fs::path& path, std::span<const std::string_view> parts) {
    write_parts(path, parts, OpenFile::Mode::create);
}

void write_private_text(const fs::path& path, std::string_view text) {
    write_parts(path, std::span(&text, 1), OpenFile::Mode::create_private);
}

void write_file(const fs::path& path, const std::function<bool(const fs::path&)>& write) {
    const fs::path temporary = temporary_beside(path);
    std::error_code ignored;
    fs::remove(temporary, ignored);  // in a folder from elsewhere it may be a link
    try {
        if (!write(temporary)) fail_to_write(path, likely_reason(path.has_parent_path() ? path.parent_path() : "."));
    } catch (const std::system_error& error) {
        fs::remove(temporary, ignored);
        fail_to_write(path, reason_of(error.code()));
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) {
        fs::remove(temporary, ignored);
        fail_to_write(path, error.message());
    }
}

FolderLock::FolderLock(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error && !fs::is_directory(folder)) {
        throw RunError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
    }
    descriptor_ = platform::lock(folder / ".lock", error);
    if (!error) return;
    if (error != std::errc::operation_would_block) {
        throw RunError(fmt::format("cannot write {}: {}", (folder / ".lock").string(), reason_of(error)));
    }
    throw UserError(
        fmt::format("another run is writing into {}; choose another folder with --output, "
                    "or wait until it has ended",
                    folder.string()));
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) platform::unlock(descriptor_);
}

bool is_locked(const fs::path& folder) {
    return platform::is_locked(folder / ".lock");
}

}  // namespace espalier
