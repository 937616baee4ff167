// A .pvd: the index ParaView opens, one data set per time and part. Whole after every frame.
#pragma once

#include "base/platform.h"

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace espalier::timeline {

class CollectionFile {
public:
    explicit CollectionFile(std::filesystem::path path) : path_(std::move(path)) {}

    /// `file` is relative to the collection's folder. Nothing is written before `write`.
    void add(double time, int part, const std::string& name, const std::string& file);
    /// Throws RunError; the old index stays then.
    void write();

    void save(std::ostream& out) const;
    /// Puts the saved index back on disk. Throws RunError.
    void restore(std::istream& in);

private:
    void write_anew();
    void extend(std::size_t at, const std::string& tail);

    std::filesystem::path path_;
    std::string entries_;
    std::size_t written_ = 0;  ///< how much of `entries_` is in the file
    platform::OpenFile file_;  ///< as it was last written anew
};

}  // namespace espalier::timeline
