#include "language/cylinders/dialect.h"

#include "language/measured/cells.h"

#include <algorithm>
#include <cctype>

namespace espalier::language::cylinders {
namespace {

constexpr std::size_t longest_head = 4096;

// TreeQSM writes a cylinder's axis, the others its end. rTwig and tables that MATLAB makes of TreeQSM's structure have
// the same columns, its older versions have short names.
constexpr std::array<Dialect, 4> dialects{
    {{"TreeQSM",
      {nullptr, "parent", "extension", "branch", "branchorder", "radius", "length", "startx", "starty", "startz",
       "axisx", "axisy", "axisz", nullptr, nullptr, nullptr},
      true},
     {"TreeQSM 2",
      {nullptr, "cpar", "cext", "bocx", "bocy", "rad", "len", "stax", "stay", "staz", "axex", "axey", "axez", nullptr,
       nullptr, nullptr},
      true},
     {"SimpleForest",
      {"id", "parentid", nullptr, "branchid", "branchorder", "radius", "length", "startx", "starty", "startz", nullptr,
       nullptr, nullptr, "endx", "endy", "endz"},
      false},
     {"aRchi",
      {"cylid", "parentid", "extensionid", "axisid", "branchingorder", "radiuscyl", "length", "startx", "starty",
       "startz", nullptr, nullptr, nullptr, "endx", "endy", "endz"},
      true}}};

/// "startx" of "start.x", "startX (m)" and "start_1".
std::string plain(std::string_view name) {
    std::string plain;
    for (const char c : name.substr(0, name.find('('))) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) continue;
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const char* const vector : {"start", "axis", "sta", "axe", "boc"}) {
        for (const int axis : {0, 1, 2}) {
            if (plain == std::string(vector) + "123"[axis]) return std::string(vector) + "xyz"[axis];
        }
    }
    return plain;
}

/// TreeQSM's own text file has one name for a point or direction, of three columns.
std::vector<std::string> spread(const std::vector<std::string_view>& cells) {
    std::vector<std::string> names;
    for (const std::string_view cell : cells) {
        const std::string name = plain(cell);
        const char* const vector = name == "startpoint" ? "start" : name == "axisdirection" ? "axis" : nullptr;
        if (!vector) {
            names.emplace_back(cell);
            continue;
        }
        for (const char axis : {'x', 'y', 'z'}) names.push_back(std::string(vector) + axis);
    }
    return names;
}

char separator_of(std::string_view line) {
    for (const char separator : {'\t', ';', ','}) {
        if (line.find(separator) != std::string_view::npos) return separator;
    }
    return ' ';
}

std::optional<Header> as(const Dialect& dialect, const std::vector<std::string>& names) {
    Header header;
    header.dialect = &dialect;
    std::vector<std::string> small;
    std::transform(names.begin(), names.end(), std::back_inserter(small), plain);
    for (std::size_t field = 0; field < fields; ++field) {
        if (!dialect.columns[field]) continue;
        const auto found = std::find(small.begin(), small.end(), dialect.columns[field]);
        if (found != small.end()) {
            header.column[field] = static_cast<std::size_t>(found - small.begin());
        } else if (field != extension && field != branch && field != order) {
            return std::nullopt;
        }
    }
    header.names = names;
    return header;
}

}  // namespace

std::optional<Header> header_of(std::string_view line) {
    const char separator = separator_of(line);
    std::vector<std::string_view> cells;
    measured::split_cells(line, separator, cells);
    const std::vector<std::string> names = spread(cells);
    for (const Dialect& dialect : dialects) {
        std::optional<Header> header = as(dialect, names);
        if (!header) continue;
        header->separator = separator;
        return header;
    }
    return std::nullopt;
}

bool is_cylinder_model(std::string_view head) {
    head = head.substr(0, longest_head);
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    for (std::size_t begin = 0; begin < head.size();) {
        const std::string_view line = measured::next_line(head, begin);
        if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with('#')) continue;
        return header_of(line).has_value();
    }
    return false;
}

}  // namespace espalier::language::cylinders
