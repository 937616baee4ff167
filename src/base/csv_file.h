// A table that grows by whole lines: valid after every row, also after a crash or on a full disk.
#pragma once

#include "base/platform.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

class CsvFile {
public:
    /// Makes the file, replacing an old one and what was kept of it, with its header (without line break). Throws
    /// RunError.
    CsvFile(const std::filesystem::path& path, std::string_view header);
    /// Goes on with a file that was `size` bytes long, and forgets what came behind. If the file is gone or shorter, it
    /// goes on with what was kept. Throws RunError if that is not enough.
    CsvFile(const std::filesystem::path& path, std::size_t size);

    /// Appends whole lines, each with its line break, in one write. Takes back a write that could not be completed
    /// and throws RunError.
    void append(std::string_view lines);
    std::size_t size() const { return size_; }  ///< bytes

    /// Gives the file a second, hidden name (a hard link), so that its rows are not lost if somebody removes it before
    /// the run goes on: make and Snakemake remove what a job that failed has left. Does nothing where the file system
    /// has no such links.
    void keep() const;
    /// Removes that name of a file.
    static void forget(const std::filesystem::path& path);

private:
    void open();

    std::filesystem::path path_;
    platform::OpenFile file_;
    std::size_t size_ = 0;
};

/// A value as CSV writes it: in quotes if it holds a comma, a quote or a line break.
std::string csv_text(std::string_view text);
/// The cells of a line, between commas or another separator; in quotes separators are text.
std::vector<std::string> csv_cells(std::string_view line, char separator = ',');
/// A number so that it reads back exactly; nothing for NaN and infinities.
std::string csv_number(double value);

}  // namespace espalier
