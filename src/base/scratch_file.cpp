#include "base/scratch_file.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace espalier {

ScratchFile::ScratchFile(const std::filesystem::path& folder) : folder_(folder) {
    open();
}

ScratchFile::~ScratchFile() {
    close();
}

void ScratchFile::open() {
    own_folder_ = folder_ / ".waiting-XXXXXX";
    if (const std::error_code error = platform::make_unique_folder(own_folder_)) fail("make", error);
    std::error_code error;
    file_ = platform::OpenFile(own_folder_ / "bytes", platform::OpenFile::Mode::scratch, error);
    if (error) fail("make", error);
    remove();  // most systems keep the bytes of an open file, and free them when the program ends, however it does
}

void ScratchFile::close() {
    static_cast<void>(file_.close());
    remove();
}

void ScratchFile::remove() {
    std::error_code is_open_or_gone;
    std::filesystem::remove_all(own_folder_, is_open_or_gone);
}

// A quarter of a megabyte or more at once: the system takes larger pages for it, and threads wait less for each other.
std::uint64_t ScratchFile::append(std::string_view bytes) {
    constexpr std::size_t enough = 1 << 18;
    const bool is_enough = bytes.size() >= enough;
    std::string full;
    std::uint64_t begin = 0;
    {
        const std::lock_guard lock(mutex_);
        begin = std::exchange(size_, size_ + bytes.size());
        if (!is_enough) waiting_.append(bytes);
        has_waiting_ = !is_enough && waiting_.size() < enough;
        if (has_waiting_) return begin;
        full.reserve(2 * enough);
        full.swap(waiting_);
    }
    write((is_enough ? begin : begin + bytes.size()) - full.size(), full);
    if (is_enough) write(begin, bytes);
    return begin;
}

std::string ScratchFile::read(std::uint64_t at, std::size_t size) {
    if (has_waiting_) write_waiting();
    std::string bytes(size, '\0');
    if (const std::error_code error = file_.read_at(at, bytes)) fail("read", error);
    return bytes;
}

void ScratchFile::clear() {
    close();
    waiting_.clear();
    has_waiting_ = false;
    size_ = 0;
    open();
}

void ScratchFile::write_waiting() {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return;
    write(size_ - waiting_.size(), waiting_);
    waiting_.clear();
    has_waiting_ = false;
}

void ScratchFile::write(std::uint64_t at, std::string_view bytes) {
    constexpr std::size_t most = 1 << 30;  // that every system writes at once
    for (; !bytes.empty(); at += most) {
        if (const std::error_code error = file_.write_at(at, bytes.substr(0, most))) fail("write", error);
        bytes.remove_prefix(std::min(most, bytes.size()));
    }
}

void ScratchFile::fail(const char* what, const std::error_code& error) const {
    throw RunError(
        fmt::format("cannot {} a file for what waits on disk in {}: {}", what, folder_.string(), error.message()));
}

}  // namespace espalier
