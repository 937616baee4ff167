// Bytes that wait on disk until they are read again, for as long as the program runs.
#pragma once

#include "base/platform.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

namespace espalier {

/// A file that is gone when this is, and where the system allows it also after the program was killed. Several threads
/// may append, and then several may read.
class ScratchFile {
public:
    /// Makes the file in a folder that exists. Throws RunError, as the others do where the disk is full or fails.
    explicit ScratchFile(const std::filesystem::path& folder);
    ~ScratchFile();

    /// Returns where the bytes lie.
    std::uint64_t append(std::string_view bytes);
    std::string read(std::uint64_t at, std::size_t size);
    /// Gives the room on disk back.
    void clear();
    std::uint64_t size() const { return size_; }

private:
    void open();
    void close();
    void remove();
    void write_waiting();
    void write(std::uint64_t at, std::string_view bytes);
    [[noreturn]] void fail(const char* what, const std::error_code& error) const;

    std::filesystem::path folder_, own_folder_;
    platform::OpenFile file_;
    std::uint64_t size_ = 0;
    std::string waiting_;                    ///< the last bytes, which are not yet in the file
    std::atomic<bool> has_waiting_ = false;  ///< so that those who read need no lock
    std::mutex mutex_;
};

}  // namespace espalier
