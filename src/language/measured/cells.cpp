#include "language/measured/cells.h"

#include <algorithm>

namespace espalier::language::measured {
namespace {

bool is_around_cells(char c) {
    return c == ' ' || c == '\r' || c == '\t' || c == '"';
}

}  // namespace

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
    cells.clear();
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t found = separator == ' ' ? line.find_first_of(" \t", begin) : line.find(separator, begin);
        const std::size_t end = std::min(found, line.size());
        std::string_view cell = line.substr(begin, end - begin);
        while (!cell.empty() && is_around_cells(cell.front())) cell.remove_prefix(1);
        while (!cell.empty() && is_around_cells(cell.back())) cell.remove_suffix(1);
        if (separator != ' ' || !cell.empty()) cells.push_back(cell);
        begin = end + 1;
    }
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

std::string_view next_line(std::string_view text, std::size_t& begin) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    return line;
}

}  // namespace espalier::language::measured
