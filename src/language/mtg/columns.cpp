#include "language/mtg/columns.h"

#include "base/number.h"
#include "base/text.h"
#include "language/measured/units.h"
#include "language/mtg/dates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::language::mtg {
namespace {

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
