#include "base/csv_rows.h"

#include "espalier/base/file.h"

#include "base/csv_file.h"
#include "base/number.h"

#include <sstream>

namespace espalier {
namespace {

std::string without_blanks(const std::string& text) {
    const char* const blanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

}  // namespace

std::optional<double> CsvRow::number(std::size_t column) const {
    return column < cells.size() ? finite_number(cells[column]) : std::nullopt;
}

CsvRows::CsvRows(const std::filesystem::path& path, bool comments) : path_(path.string()) {
    std::istringstream text(read_text(path));
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
        if (without_blanks(line).empty() || (comments && line.front() == '#')) continue;
        CsvRow& row = rows_.emplace_back();
        row.line = number;
        for (const std::string& cell : csv_cells(line)) row.cells.push_back(without_blanks(cell));
    }
}

}  // namespace espalier
