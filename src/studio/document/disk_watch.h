// What stands in the files of a document on disk, and which of them other programs have written since.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace espalier::studio {

class DiskWatch {
public:
    /// Bytes of this digest (read_log.h) stand in the file, as far as is known.
    void know(const std::filesystem::path& file, std::uint64_t digest) { known_[file] = {digest}; }
    /// What stands there now is known. A file that is not there is not watched.
    void accept(const std::filesystem::path& file);
    bool knows(const std::filesystem::path& file) const { return known_.contains(file); }
    /// Returns the digest of a file that is known.
    std::uint64_t digest_of(const std::filesystem::path& file) const { return known_.at(file).digest; }
    void forget() { known_.clear(); }

    /// The files in which something else stands than what is known. Those that are gone are not among them: many
    /// programs remove a file for a moment while they write it. A file is read only if its size or time has changed.
    std::vector<std::filesystem::path> changed();

private:
    struct Stamp {
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    struct Known {
        std::uint64_t digest = 0;
        Stamp stamp{};  ///< when it was last read
        bool differs = false;
    };

    static bool look(const std::filesystem::path& file, Known& known);

    std::map<std::filesystem::path, Known> known_;
};

}  // namespace espalier::studio
