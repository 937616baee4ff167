#include "espalier/base/file.h"

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <sys/uio.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
    return std::generic_category().message(error);
}

/// 0, or the system's error.
int try_lock(int descriptor, int kind) {
    return ::flock(descriptor, kind | LOCK_NB) == 0 ? 0 : errno;
}

[[noreturn]] void fail_to_write(const fs::path& path, const std::string& why) {
    throw RunError(fmt::format("cannot write {}: {}", path.string(), why));
}

fs::path temporary_beside(const fs::path& path) {
    // Hidden, of this process, with the extension writers go by.
    return path.parent_path() / fmt::format(".{}.{}.part{}", path.stem().string(), getpid(), path.extension().string());
}

// In few calls: a kernel that is given much at once takes larger pages for it.
void write_all(int descriptor, std::span<const std::string_view> parts) {
    constexpr std::size_t most = 512;  // below IOV_MAX, 1024 where there are such systems
    std::vector<iovec> pieces;
    for (const std::string_view part : parts) {
        if (!part.empty()) pieces.push_back({const_cast<char*>(part.data()), part.size()});
    }
    for (std::size_t first = 0; first < pieces.size();) {
        const std::size_t count = std::min(most, pieces.size() - first);
        const ssize_t result = ::writev(descriptor, &pieces[first], static_cast<int>(count));
        if (result < 0 && errno == EINTR) continue;
        if (result < 0) throw std::system_error(errno, std::generic_category());
        auto written = static_cast<std::size_t>(result);
        for (; first < pieces.size() && written >= pieces[first].iov_len; ++first) written -= pieces[first].iov_len;
        if (written == 0) continue;
        pieces[first].iov_base = static_cast<char*>(pieces[first].iov_base) + written;
        pieces[first].iov_len -= written;
    }
}

// Why a writer may have failed without saying so.
std::string likely_reason(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) return "the folder " + folder.string() + " is missing";
    if (::access(folder.c_str(), W_OK) != 0) return reason(errno);
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
        const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor < 0) throw std::system_error(errno, std::generic_category());
        try {
            write_all(descriptor, parts);
        } catch (...) {
            ::close(descriptor);
            throw;
        }
        // Some file systems report a full disk only here.
        if (::close(descriptor) != 0) throw std::system_error(errno, std::generic_category());
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
    const fs::path file = folder / ".lock";
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw RunError(fmt::format("cannot write into {}: {}", folder.string(), reason(errno)));
    int error_number = try_lock(descriptor_, LOCK_EX);
    // `is_locked` holds it for a moment, too.
    for (int i = 0; i < 5 && error_number == EWOULDBLOCK; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        error_number = try_lock(descriptor_, LOCK_EX);
    }
    if (error_number != 0) {
        ::close(descriptor_);
        if (error_number != EWOULDBLOCK) {
            throw RunError(fmt::format("cannot lock {}: {}", folder.string(), reason(error_number)));
        }
        throw UserError(
            fmt::format("another run is writing into {}; choose another folder with --output, "
                        "or wait until it has ended",
                        folder.string()));
    }
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool is_locked(const fs::path& folder) {
    const int descriptor = ::open((folder / ".lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return errno != ENOENT;
    const int error_number = try_lock(descriptor, LOCK_SH);
    ::close(descriptor);
    return error_number != 0;
}

}  // namespace espalier
