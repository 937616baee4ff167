#include "environment/given/weather/series_clock.h"

#include "base/number.h"
#include "base/text.h"
#include "base/unit_text.h"
#include "environment/given/weather/weather_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

namespace espalier::environment {
namespace {

constexpr std::array<std::pair<const char*, double>, 4> units_of_time{
    {{"h", 1}, {"min", 1.0 / 60}, {"s", 1.0 / 3600}, {"d", 24}}};

double hours_of_unit(const ColumnHead& head, const Place& place) {
    std::vector<std::string> names;
    for (const auto& [name, hours] : units_of_time) {
        if (plain_unit(head.unit) == name) return hours;
        names.emplace_back(name);
    }
    refuse_unit(place, head, names);
}

/// The whole number of so many digits at a place of the text.
std::optional<int> digits(const std::string& text, std::size_t at, std::size_t count) {
    if (at + count > text.size()) return std::nullopt;
    return whole_text_as<int>(std::string_view(text).substr(at, count));
}

}  // namespace

ColumnHead ColumnHead::of(const std::string& cell) {
    NameAndUnit both = name_and_unit(cell);
    return {in_small_letters(both.name), std::move(both.unit)};
}

void refuse_unit(const Place& place, const ColumnHead& head, const std::vector<std::string>& units,
                 const std::string& hint) {
    throw UserError(place,
                    fmt::format("the column '{}' has the unit '{}': write {} ({}), where the unit is one of: {}{}",
                                head.name, head.unit, head.name, units.front(), fmt::join(units, ", "), hint));
}

std::optional<SeriesClock> SeriesClock::find(const CsvRows& table, const CsvRow& header) {
    for (std::size_t column = 0; column < header.cells.size(); ++column) {
        const ColumnHead head = ColumnHead::of(header.cells[column]);
        if (head.name == "date") return SeriesClock(column, 0, false);
        if (head.name == "time") return SeriesClock(column, hours_of_unit(head, table.place(header, column)), false);
    }
    return std::nullopt;
}

double SeriesClock::hours(const CsvRows& table, const CsvRow& row) {
    return hours_ == 0 ? hours_of_date(table, row) : number(table, row) * hours_;
}

double SeriesClock::days(const CsvRows& table, const CsvRow& row) {
    return hours_ == 24 ? number(table, row) : hours(table, row) / 24;
}

double SeriesClock::number(const CsvRows& table, const CsvRow& row) const {
    const auto refuse = [&](const char* why) {
        const std::string cell = column_ < row.cells.size() ? row.cells[column_] : "";
        throw UserError(table.place(row, column_), fmt::format("the time is '{}', {}", cell, why));
    };
    const std::optional<double> time = row.number(column_);
    if (!time) refuse("which is no number");
    if (*time < 0 && !may_be_negative_) refuse("below 0");
    return *time;
}

double SeriesClock::hours_of_date(const CsvRows& table, const CsvRow& row) {
    const std::string cell = column_ < row.cells.size() ? row.cells[column_] : "";
    const bool is_day = cell.size() == 10;
    const auto year = digits(cell, 0, 4), month = digits(cell, 5, 2), day = digits(cell, 8, 2);
    const auto hour = is_day ? std::optional(0) : digits(cell, 11, 2);
    const auto minute = is_day ? std::optional(0) : digits(cell, 14, 2);
    const auto second = cell.size() > 16 ? digits(cell, 17, 2) : std::optional(0);
    const auto midnight = days_of_date(year.value_or(0), month.value_or(0), day.value_or(0));
    if (!year || !hour || !minute || !second || !midnight || *hour > 24 || *minute > 59 || *second > 60) {
        throw UserError(table.place(row, column_),
                        fmt::format("'{}' is no date: write 2025-06-21 13:30, civil time of the place", cell));
    }
    if (day_ == 0) {
        first_midnight_ = *midnight;
        year_ = *year;
        day_ = day_of_year(*year, *month, *day);
    }
    return 24.0 * static_cast<double>(*midnight - first_midnight_) + *hour + *minute / 60.0 + *second / 3600.0;
}

}  // namespace espalier::environment
