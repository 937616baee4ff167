#include "base/scratch_file.h"

#include "espalier/base/error.h"

#include "base/platform.h"

#include <fmt/format.h>

#include <cerrno>
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
    file_.open(own_folder_ / "bytes", std::ios::in | std::ios::out | std::ios::binary | std::ios::trunc);
    if (!file_) fail("make", {errno, std::generic_category()});
    remove();  // most systems keep the bytes of an open file, and free them when the program ends, however it does
}

void ScratchFile::close() {
    file_.close();
    remove();
}

void ScratchFile::remove() {
    std::error_code is_open_or_gone;
    std::filesystem::remove_all(own_folder_, is_open_or_gone);
}

std::uint64_t ScratchFile::append(std::string_view bytes) {
    const std::lock_guard lock(mutex_);
    file_.seekp(static_cast<std::streamoff>(size_));
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file_.flush()) fail("write", {errno, std::generic_category()});
    return std::exchange(size_, size_ + bytes.size());
}

std::string ScratchFile::read(std::uint64_t at, std::size_t size) {
    std::string bytes(size, '\0');
    const std::lock_guard lock(mutex_);
    file_.seekg(static_cast<std::streamoff>(at));
    if (!file_.read(bytes.data(), static_cast<std::streamsize>(size))) fail("read", {errno, std::generic_category()});
    return bytes;
}

void ScratchFile::clear() {
    close();
    size_ = 0;
    open();
}

void ScratchFile::fail(const char* what, const std::error_code& error) const {
    throw RunError(
        fmt::format("cannot {} a file for what waits on disk in {}: {}", what, folder_.string(), error.message()));
}

}  // namespace espalier
