#include "environment/sky/light_series.h"

#include "base/csv_rows.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace espalier::environment {

/// What to do with a cell: a value of the row, times a factor.
struct LightSeries::Column {
    double MeasuredLight::*value = nullptr;  ///< null: not ours
    double factor = 1;
    bool is_date = false;
    std::string name = {};
};

namespace {

struct ColumnUnit {
    const char* unit;
    double factor;
};

struct KnownColumn {
    const char* name;
    double MeasuredLight::*value;
    std::vector<ColumnUnit> units;
};

std::vector<KnownColumn> known_columns(double photons) {
    const std::vector<ColumnUnit> power{{"W m-2", 1}, {"W/m2", 1}, {"kW m-2", 1000}, {"kW/m2", 1000}};
    return {{"time", &MeasuredLight::hours, {{"h", 1}, {"min", 1.0 / 60}, {"s", 1.0 / 3600}, {"d", 24}}},
            {"global", &MeasuredLight::global, power},
            {"diffuse", &MeasuredLight::diffuse, power},
            {"direct", &MeasuredLight::direct, power},
            {"par",
             &MeasuredLight::par,
             {{"umol m-2 s-1", 1}, {"umol/m2/s", 1}, {"mol m-2 s-1", 1e6}, {"W m-2", photons}, {"W/m2", photons}}}};
}

std::string trimmed(std::string text) {
    const char* const blanks = " \t\r";
    text.erase(0, std::min(text.find_first_not_of(blanks), text.size()));
    text.erase(text.find_last_not_of(blanks) + 1);
    return text;
}

/// "global (W m-2)" or "global [W m-2]" as name and unit.
std::pair<std::string, std::string> name_and_unit(const std::string& cell) {
    const std::size_t open = cell.find_first_of("(["), close = cell.find_last_of(")]");
    if (open == std::string::npos || close == std::string::npos || close < open) return {trimmed(cell), ""};
    return {trimmed(cell.substr(0, open)), trimmed(cell.substr(open + 1, close - open - 1))};
}

/// The whole number of so many digits at a place of the text.
std::optional<int> digits(const std::string& text, std::size_t at, std::size_t count) {
    if (at + count > text.size()) return std::nullopt;
    return whole_text_as<int>(std::string_view(text).substr(at, count));
}

}  // namespace

void LightSeries::refuse(int line, int column, const std::string& message) const {
    throw UserError({path_.string(), line, column}, message);
}

LightSeries::LightSeries(const std::filesystem::path& path, double photons) : path_(path) {
    const CsvRows table(path, true);
    std::vector<Column> columns;
    for (const CsvRow& row : table.rows()) {
        if (columns.empty()) {
            columns = columns_of(row, photons);
        } else {
            read_row(row, columns);
        }
    }
    if (rows_.size() < 2) refuse(0, 0, "a series of light needs a header and two rows at least");
    require_even_times();
}

std::vector<LightSeries::Column> LightSeries::columns_of(const CsvRow& header, double photons) const {
    const std::vector<KnownColumn> known = known_columns(photons);
    std::vector<Column> columns;
    bool has_time = false, has_light = false;
    for (const std::string& cell : header.cells) {
        const auto [name, unit] = name_and_unit(cell);
        Column column;
        column.name = name;
        column.is_date = name == "date";
        has_time = has_time || name == "date" || name == "time";
        has_light = has_light || name == "global" || name == "par";
        for (const KnownColumn& one : known) {
            if (name != one.name) continue;
            const auto found =
                std::find_if(one.units.begin(), one.units.end(),
                             [&unit = unit](const ColumnUnit& known_unit) { return unit == known_unit.unit; });
            if (found == one.units.end()) {
                std::vector<std::string> units;
                for (const ColumnUnit& known_unit : one.units) units.push_back(known_unit.unit);
                refuse(header.line, static_cast<int>(columns.size() + 1),
                       fmt::format("the column '{}' has the unit '{}': write {} ({}), where the unit is one of: {}",
                                   name, unit, name, units.front(), fmt::join(units, ", ")));
            }
            column.value = one.value;
            column.factor = found->factor;
        }
        columns.push_back(column);
    }
    if (!has_time)
        refuse(header.line, 0, "the header names no column 'time (h)' or 'date': when was the light measured?");
    if (!has_light) refuse(header.line, 0, "the header names neither 'global (W m-2)' nor 'par (umol m-2 s-1)'");
    return columns;
}

double LightSeries::read_date(const std::string& cell, int number, int column) {
    const auto year = digits(cell, 0, 4), month = digits(cell, 5, 2), day = digits(cell, 8, 2);
    const auto hour = digits(cell, 11, 2), minute = digits(cell, 14, 2);
    const auto second = cell.size() > 16 ? digits(cell, 17, 2) : std::optional(0);
    using namespace std::chrono;
    const year_month_day date(std::chrono::year(year.value_or(0)),
                              std::chrono::month(static_cast<unsigned>(std::max(0, month.value_or(0)))),
                              std::chrono::day(static_cast<unsigned>(std::max(0, day.value_or(0)))));
    if (!year || !hour || !minute || !second || !date.ok() || *hour > 24 || *minute > 59 || *second > 60) {
        refuse(number, column, fmt::format("'{}' is no date: write 2025-06-21 13:30, civil time of the place", cell));
    }
    const long long midnight = sys_days(date).time_since_epoch().count();
    if (rows_.empty()) {
        first_midnight_ = midnight;
        year_ = *year;
        day_ = static_cast<int>(midnight - sys_days(date.year() / January / 1).time_since_epoch().count()) + 1;
    }
    return 24.0 * static_cast<double>(midnight - first_midnight_) + *hour + *minute / 60.0 + *second / 3600.0;
}

void LightSeries::read_row(const CsvRow& read, std::span<const Column> columns) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const int number = read.line;
    MeasuredLight row{unknown, unknown, unknown, unknown, unknown, number};
    const std::vector<std::string>& cells = read.cells;
    if (cells.size() != columns.size()) {
        refuse(number, 0, fmt::format("this row has {} cells, and the header {}", cells.size(), columns.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int column = static_cast<int>(i + 1);
        const std::string& cell = cells[i];
        if (columns[i].is_date) row.hours = read_date(cell, number, column);
        if (!columns[i].value) continue;
        const std::optional<double> value = read.number(i);
        if (!value) {
            refuse(number, column,
                   fmt::format("'{}' is '{}', which is no number: a series has no holes", columns[i].name, cell));
        }
        if (*value < 0) refuse(number, column, fmt::format("'{}' is {}, below 0", columns[i].name, cell));
        row.*columns[i].value = *value * columns[i].factor;
    }
    if (row.diffuse > 1.001 * row.global) {
        refuse(number, 0,
               fmt::format("the diffuse light, {:g} W m-2, is more than all of it, {:g}", row.diffuse, row.global));
    }
    if (row.direct > 1.001 * row.global) {
        refuse(
            number, 0,
            fmt::format("the direct light, {:g} W m-2, is more than all of it, {:g}: it must be that on level ground",
                        row.direct, row.global));
    }
    rows_.push_back(row);
}

void LightSeries::require_even_times() const {
    std::vector<double> spans;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
        spans.push_back(rows_[i].hours - rows_[i - 1].hours);
        if (!(spans.back() > 0)) refuse(rows_[i].line, 0, "the time of this row is not after that of the row before");
    }
    std::vector<double> sorted = spans;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < spans.size(); ++i) {
        if (spans[i] <= 1.5 * usual) continue;
        refuse(rows_[i + 1].line, 0,
               fmt::format("there is a gap in time: {:g} hours since the row before, where others are {:g} apart",
                           spans[i], usual));
    }
    const auto is_dark = [](const MeasuredLight& row) { return !(row.global > 0) && !(row.par > 0); };
    if (std::all_of(rows_.begin(), rows_.end(), is_dark)) refuse(0, 0, "there is no light in any row");
}

MeasuredLight LightSeries::at(double hours) const {
    const auto after = std::lower_bound(rows_.begin() + 1, rows_.end() - 1, hours,
                                        [](const MeasuredLight& row, double at) { return row.hours < at; });
    const MeasuredLight &a = *(after - 1), &b = *after;
    const double t = std::clamp((hours - a.hours) / (b.hours - a.hours), 0.0, 1.0);
    const auto between = [&](double MeasuredLight::*value) { return (1 - t) * (a.*value) + t * (b.*value); };
    return {hours,
            between(&MeasuredLight::global),
            between(&MeasuredLight::diffuse),
            between(&MeasuredLight::direct),
            between(&MeasuredLight::par),
            a.line};
}

}  // namespace espalier::environment
