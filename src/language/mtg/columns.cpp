#include "language/mtg/columns.h"

#include "base/number.h"
#include "base/text.h"
#include "language/measured/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::language::mtg {
namespace {

struct Parts {
    std::array<int, 3> number{};
    std::size_t count = 0;
};

std::optional<Parts> parts_of(std::string_view text, char separator) {
    Parts parts;
    while (true) {
        const std::size_t end = std::min(text.find(separator), text.size());
        const std::optional<int> number = whole_text_as<int>(text.substr(0, end));
        if (!number || *number < 0 || parts.count == parts.number.size()) return std::nullopt;
        parts.number[parts.count++] = *number;
        if (end == text.size()) return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> day_number(int year, int month, int day) {
    const int whole = year < 70 ? 2000 + year : year < 100 ? 1900 + year : year;
    const std::chrono::year_month_day date{std::chrono::year(whole), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (month > 12 || day > 31 || whole > 9999 || !date.ok()) return std::nullopt;
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

/// A share of the day.
std::optional<double> time_of(std::string_view text) {
    const std::optional<Parts> parts = parts_of(text, ':');
    if (!parts || parts->number[0] > 24 || parts->number[1] > 59 || parts->number[2] > 59) return std::nullopt;
    return (parts->number[0] + (parts->number[1] + parts->number[2] / 60.0) / 60) / 24;
}

/// Whether FEATURES declares a column of dates by this word: DD/MM, DD/MM/YY, MM/YY or DD/MM-TIME.
bool is_type_of_dates(std::string_view type) {
    return type.find("MM") != std::string_view::npos && type.find('/') != std::string_view::npos;
}

/// Days from 1 January 1970 for 31/12/2007, 31/12/07 and 12/2007; for 31/12 and 31/12-14:30, which name no year, from 1
/// January of one without leap day. A column of the type MM/YY holds months and years. None for what is no date.
std::optional<double> days_of(std::string_view text, std::string_view type) {
    const std::size_t dash = text.find('-');
    const std::optional<Parts> date = parts_of(text.substr(0, dash), '/');
    const std::optional<double> time = dash == std::string_view::npos ? 0 : time_of(text.substr(dash + 1));
    if (!date || date->count < 2 || !time) return std::nullopt;
    const auto& [first, second, third] = date->number;
    std::optional<double> days;
    if (date->count == 3) {
        days = day_number(third, second, first);
    } else if (type.starts_with("MM/YY") || second > 12) {
        days = day_number(second, first, 1);
    } else if (const std::optional<double> in_1970 = day_number(1970, second, first)) {
        days = in_1970;
    }
    return days ? std::optional(*days + *time) : std::nullopt;
}

constexpr double largest = 1e12;

/// A column that is read. Of several for one measure the first of this table counts.
struct KnownColumn {
    std::string_view name;
    Measure measure;
    double factor = 1;
};

constexpr std::array<KnownColumn, 24> known_columns{{{"xx", x},
                                                     {"x", x},
                                                     {"yy", y},
                                                     {"y", y},
                                                     {"zz", z},
                                                     {"z", z},
                                                     {"diameter", top},
                                                     {"diam", top},
                                                     {"dia", top},
                                                     {"topdiameter", top},
                                                     {"topdia", top},
                                                     {"radius", top, 2},
                                                     {"topradius", top, 2},
                                                     {"botdia", bottom},
                                                     {"bottomdia", bottom},
                                                     {"botdiameter", bottom},
                                                     {"bottomdiameter", bottom},
                                                     {"basedia", bottom},
                                                     {"basediameter", bottom},
                                                     {"botradius", bottom, 2},
                                                     {"length", length},
                                                     {"len", length},
                                                     {"birth", day},
                                                     {"date", day}}};

}  // namespace

void Columns::declare(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "NAME") return;
    Declared column{words[0], words.size() > 1 ? words[1] : "", ""};
    if (words.size() > 2 && measured::metres_of(words[2])) column.unit = words[2];
    declared_.push_back(std::move(column));
}

void Columns::give_measure(Column& column) {
    for (std::size_t rank = 0; rank < known_columns.size(); ++rank) {
        if (known_columns[rank].name != column.small) continue;
        column.measure = known_columns[rank].measure;
        column.factor = known_columns[rank].factor;
        column.rank = static_cast<int>(rank);
    }
    column.is_date = is_type_of_dates(column.type) || column.small == "date";
    if (!column.measure && column.is_date) {
        column.measure = day;
        column.rank = static_cast<int>(known_columns.size());
    }
}

void Columns::head(const std::vector<std::string_view>& cells, std::size_t first) {
    first_ = first;
    for (std::size_t i = first; i < cells.size(); ++i) {
        Column& column = columns_.emplace_back();
        column.name = cells[i];
        column.small = in_small_letters(cells[i]);
        for (const Declared& each : declared_) {
            if (each.name == column.name) column.type = each.type, column.unit = each.unit;
        }
        give_measure(column);
    }
    for (Column& column : columns_) {
        if (!column.measure) continue;
        const bool is_first = std::none_of(columns_.begin(), columns_.end(), [&](const Column& other) {
            return &other != &column && other.measure == column.measure &&
                   (other.rank < column.rank || (other.rank == column.rank && &other < &column));
        });
        column.is_read = is_first;
        if (is_first && *column.measure == day) {
            has_days_ = true;
            has_dates_ = column.is_date;
        }
    }
}

std::optional<double> Columns::number_in(const Column& column, std::string_view cell) const {
    if (column.is_date) return days_of(cell, column.type);
    const std::optional<double> value = finite_number(cell);
    return value && std::abs(*value) < largest ? std::optional(column.factor * *value) : std::nullopt;
}

Measures Columns::read(const std::vector<std::string_view>& cells, const Place& place, measured::Notes& notes) {
    Measures values;
    values.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = first_; i < cells.size(); ++i) {
        if (cells[i].empty()) continue;
        if (i - first_ >= columns_.size() || columns_[i - first_].name.empty()) {
            notes.unused("a cell below no name of the line ENTITY-CODE", place);
            continue;
        }
        Column& column = columns_[i - first_];
        if (!column.is_read) {
            if (column.filled++ == 0) column.first = place;
            continue;
        }
        if (!column.measure) continue;
        if (const std::optional<double> value = number_in(column, cells[i])) {
            values[*column.measure] = *value;
        } else if (cells[i] != "NA" && cells[i] != "-") {
            notes.warn(fmt::format("column '{}' holds what is no {}", escaped(column.name),
                                   column.is_date ? "date" : "number"),
                       place);
        }
    }
    return values;
}

std::string_view Columns::cell(const std::vector<std::string_view>& cells, std::string_view name) {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (columns_[i].small != name) continue;
        columns_[i].is_read = true;
        return first_ + i < cells.size() ? cells[first_ + i] : std::string_view();
    }
    return {};
}

void Columns::tell_unused(measured::Notes& notes) const {
    for (const Column& column : columns_) {
        if (column.filled > 0) {
            notes.unused(fmt::format("column '{}'", escaped(column.name)), column.first, column.filled);
        }
    }
}

std::string Columns::unit_of(Measure measure) const {
    for (const Column& column : columns_) {
        if (column.is_read && column.measure == measure && !column.unit.empty()) return column.unit;
    }
    return "";
}

std::vector<std::string> Columns::names() const {
    std::vector<std::string> names;
    for (const Column& column : columns_) {
        if (!column.name.empty()) names.push_back(column.name);
    }
    return names;
}

std::vector<Measure> Columns::measures_read() const {
    std::vector<Measure> read;
    for (const Column& column : columns_) {
        if (column.is_read && column.measure) read.push_back(*column.measure);
    }
    return read;
}

}  // namespace espalier::language::mtg
