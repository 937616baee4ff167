// A table of comma-separated values, read whole: rows of cells that know their place.
#pragma once

#include "espalier/base/error.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier {

struct CsvRow {
    int line = 0;                    ///< of the file, from 1
    std::vector<std::string> cells;  ///< without the blanks around them

    /// A cell as a finite number; nothing if it is none, or is not there.
    std::optional<double> number(std::size_t column) const;
};

class CsvRows {
public:
    /// Leaves out empty lines and, if `comments`, those that begin with #. Throws UserError for a file that cannot be
    /// read.
    CsvRows(const std::filesystem::path& path, bool comments);

    const std::vector<CsvRow>& rows() const { return rows_; }
    /// Of a row, and of a cell of it, counted from 0.
    Place place(const CsvRow& row) const { return {path_, row.line, 0}; }
    Place place(const CsvRow& row, std::size_t column) const { return {path_, row.line, static_cast<int>(column) + 1}; }

private:
    std::string path_;
    std::vector<CsvRow> rows_;
};

}  // namespace espalier
