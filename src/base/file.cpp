#include "espalier/base/file.h"

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"

#include "base/platform.h"

#include <fmt/format.h>

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

}  // namespace

std::string read_text(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) throw UserError(fmt::format("cannot read {}: it is a folder", path.string()));
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
    write_file(path, [&](const fs::path& temporary) {
        std::error_code error;
        OpenFile file(temporary, OpenFile::Mode::create, error);
        if (!error) error = file.write(parts);
        if (!error) error = file.close();
        if (error) throw std::system_error(error);
        return true;
    });
}

void write_file(const fs::path& path, const std::function<bool(const fs::path&)>& write) {
    const fs::path temporary = temporary_beside(path);
    std::error_code ignored;
    try {
        if (!write(temporary)) fail_to_write(path, likely_reason(path.has_parent_path() ? path.parent_path() : "."));
    } catch (const std::system_error& error) {
        fs::remove(temporary, ignored);
        fail_to_write(path, error.code().message());
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
        throw RunError(fmt::format("cannot write into {}: {}", folder.string(), error.message()));
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
