// Which files a piece of work has read, which must be kept to repeat it, and which it may read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// FNV-1a, 64 bits (Fowler, Noll & Vo 1991): detects files that changed, not forged ones.
/// `before`: the digest of the bytes before these.
std::uint64_t digest(std::string_view bytes, std::uint64_t before = 0xCBF29CE484222325);

/// Texts that stand for files while they are edited, by the files' absolute paths without `.` and `..`.
using UnsavedTexts = std::map<std::filesystem::path, std::string>;

/// What a piece of work may read, if that is not everything.
struct ReadPermission {
    std::vector<std::filesystem::path> folders;  ///< files below one of them, whatever links lead there or out
    std::size_t most_bytes = 0;                  ///< most bytes of one file
};

/// While it lives, it notes every file that read_text() reads on its own thread, and on others within a Scope of it. A
/// world notes what its plants read in the log of the thread that made it. A second log of a thread takes over from the
/// first until it ends.
class ReadLog {
public:
    struct File {
        std::uint64_t digest = 0;
        std::size_t size = 0;
        std::string bytes;  ///< empty if it is not kept
        bool kept = false;
    };

    /// Files are kept in full until they are `most_kept` bytes together; of others only size and digest are.
    /// Where `unsaved` has a text, read_text() gives that instead of the file's, which must exist.
    /// Without a permission of its own, that of the log before it on this thread holds; without one, it may read all.
    explicit ReadLog(std::size_t most_kept = std::size_t(16) << 20, UnsavedTexts unsaved = {},
                     std::optional<ReadPermission> permission = {});
    ~ReadLog();
    ReadLog(const ReadLog&) = delete;
    ReadLog& operator=(const ReadLog&) = delete;

    /// By their paths, absolute and without `.` and `..`. A file read twice is what it was first.
    std::map<std::filesystem::path, File> files() const;

    /// The log of this thread; null if there is none.
    static ReadLog* current();

    /// While it lives, `log` (may be null) notes what this thread reads.
    class Scope {
    public:
        explicit Scope(ReadLog* log);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        ReadLog* before_;
    };

    // Called by read_text(), and for programs, whose bytes are not kept.
    static void note(const std::filesystem::path& path, std::string_view bytes, bool kept = true);
    /// What stands for the file on this thread; none: the file itself.
    static std::optional<std::string> unsaved(const std::filesystem::path& path);
    /// What this thread may read; null if that is everything.
    static const ReadPermission* permission();

private:
    void add(const std::filesystem::path& path, std::string_view bytes, bool kept);

    const std::size_t most_kept_;
    const UnsavedTexts unsaved_;
    const std::optional<ReadPermission> permission_;
    std::size_t kept_ = 0;
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, File> files_;
    Scope scope_{this};
};

}  // namespace espalier
