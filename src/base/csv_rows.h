// A table of separated values, read whole: rows of cells that know their place.
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

    /// A cell as a finite number; nothing if it is none, or is not there. Where commas do not separate cells, one may
    /// stand for the decimal point.
    std::optional<double> number(std::size_t column) const;
    /// Whether a cell stands for a value that was not measured: empty, a word as NA, or a number that loggers and
    /// weather files write instead of one, as 9999, -9999 or -6999.
    bool is_missing(std::size_t column) const;
    /// Says so of a number, and what to write if it was measured none the less.
    std::string words_of_missing(std::size_t column) const;

    bool has_decimal_commas = false;
};

/// The text of a table without its byte-order mark. Throws UserError for a file that cannot be read, or is UTF-16.
std::string table_text(const std::filesystem::path& path);

class CsvRows {
public:
    /// Leaves out empty lines and those that begin with #. Cells are separated by commas, semicolons or
    /// tabs, whichever are most in the first row; a byte-order mark is passed over. Throws UserError for a file that
    /// cannot be read.
    explicit CsvRows(const std::filesystem::path& path);
    /// The same of a text that was read already, by `table_text`.
    CsvRows(const std::filesystem::path& path, const std::string& text);

    const std::vector<CsvRow>& rows() const { return rows_; }
    /// "commas", "semicolons" or "tabs".
    const char* separators() const;
    /// Of a row, and of a cell of it, counted from 0.
    Place place(const CsvRow& row) const { return {path_, row.line, 0}; }
    Place place(const CsvRow& row, std::size_t column) const { return {path_, row.line, static_cast<int>(column) + 1}; }
    /// A cell as a finite number. Throws UserError at it.
    double number(const CsvRow& row, std::size_t column) const;
    /// The same of a value that was measured, of `series`, which has no gaps.
    double measured(const CsvRow& row, std::size_t column, const std::string& series) const;

private:
    std::string path_;
    char separator_ = ',';
    std::vector<CsvRow> rows_;
};

}  // namespace espalier
