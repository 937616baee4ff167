#include "base/csv_rows.h"

#include "espalier/base/file.h"

#include "base/byte_order_mark.h"
#include "base/csv_file.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace espalier {
namespace {

/// What is most in the line outside of quotes.
char separator_of(const std::string& line) {
    char best = ',';
    for (const char separator : {';', '\t'}) {
        if (csv_cells(line, separator).size() > csv_cells(line, best).size()) best = separator;
    }
    return best;
}

bool is_word_of_missing(std::string word) {
    static constexpr std::array<std::string_view, 11> words{"",    "-",    ".",    "na",      "n/a",   "#n/a",
                                                            "nan", "null", "none", "missing", "nodata"};
    word = in_small_letters(word);
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::optional<double> CsvRow::number(std::size_t column) const {
    if (column >= cells.size()) return std::nullopt;
    std::string cell = cells[column];
    if (has_decimal_commas && std::count(cell.begin(), cell.end(), ',') == 1) {
        std::replace(cell.begin(), cell.end(), ',', '.');
    }
    return finite_number(cell);
}

bool CsvRow::is_missing(std::size_t column) const {
    if (column >= cells.size() || is_word_of_missing(cells[column])) return true;
    // Weather files (EPW) write 9999 and 999999; loggers of Campbell Scientific 6999 and 7999, of either sign.
    static constexpr std::array codes{9999.0,    99999.0, 999999.0, 9999999.0, -9999.0, -99999.0,
                                      -999999.0, 6999.0,  -6999.0,  7999.0,    -7999.0};
    const std::optional<double> value = number(column);
    return value && std::find(codes.begin(), codes.end(), *value) != codes.end();
}

std::string CsvRow::words_of_missing(std::size_t column) const {
    const std::string& cell = cells[column];
    return fmt::format("'{}' stands for a value that was not measured (if it was, write {}{})", cell, cell,
                       cell.find_first_of(".,") == std::string::npos ? ".01" : "1");
}

std::string table_text(const std::filesystem::path& path) {
    std::string text = read_text(path);
    text.erase(0, byte_order_mark(text));
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        throw UserError({path.string(), 1, 0}, "this file is UTF-16: save it as CSV in UTF-8");
    }
    return text;
}

CsvRows::CsvRows(const std::filesystem::path& path) : CsvRows(path, table_text(path)) {}

CsvRows::CsvRows(const std::filesystem::path& path, const std::string& text) : path_(path.string()) {
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (trimmed(line).empty() || line.front() == '#') continue;
        if (rows_.empty()) separator_ = separator_of(line);
        CsvRow& row = rows_.emplace_back();
        row.line = number;
        row.has_decimal_commas = separator_ != ',';
        for (const std::string& cell : csv_cells(line, separator_)) row.cells.emplace_back(trimmed(cell));
    }
}

const char* CsvRows::separators() const {
    return separator_ == ',' ? "commas" : separator_ == ';' ? "semicolons" : "tabs";
}

double CsvRows::number(const CsvRow& row, std::size_t column) const {
    if (const std::optional<double> value = row.number(column)) return *value;
    const std::string cell = column < row.cells.size() ? row.cells[column] : "";
    throw UserError(place(row, column), fmt::format("'{}' is not a number", cell));
}

double CsvRows::measured(const CsvRow& row, std::size_t column, const std::string& series) const {
    if (column >= row.cells.size() || row.cells[column].empty()) {
        throw UserError(place(row, column), fmt::format("there is no number here: {} has no gaps", series));
    }
    const double value = number(row, column);
    if (!row.is_missing(column)) return value;
    throw UserError(place(row, column), fmt::format("{}: {} has no gaps", row.words_of_missing(column), series));
}

}  // namespace espalier
