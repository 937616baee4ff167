// A .pvd: the index ParaView opens, one data set per time and part. Rewritten whole after every frame.
#pragma once

#include <filesystem>
#include <string>

namespace espalier {

class CollectionFile {
public:
    explicit CollectionFile(std::filesystem::path path) : path_(std::move(path)) {}

    /// `file` is relative to the collection's folder. Nothing is written before `write`.
    void add(double time, int part, const std::string& name, const std::string& file);
    /// Throws RunError; the old index stays then.
    void write() const;

private:
    std::filesystem::path path_;
    std::string entries_;
};

}  // namespace espalier
