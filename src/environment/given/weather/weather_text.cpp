#include "environment/given/weather/weather_text.h"

#include "base/csv_file.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <sstream>

namespace espalier::environment {
namespace {

bool is_code(double value, double missing) {
    return missing > 0 ? value >= missing : value <= missing;
}

bool is_leap_year(int year) {
    return std::chrono::year(year).is_leap();
}

}  // namespace

std::vector<TextLine> weather_lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<TextLine> lines;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::string_view words = trimmed(line);
        if (!words.empty()) lines.push_back({number, std::string(words)});
    }
    return lines;
}

std::vector<std::string> weather_cells(const std::string& text) {
    std::vector<std::string> cells = csv_cells(text);
    for (std::string& cell : cells) cell = std::string(trimmed(cell));
    return cells;
}

std::optional<double> weather_number(const std::string& cell) {
    return finite_number(cell.starts_with('+') ? std::string_view(cell).substr(1) : std::string_view(cell));
}

std::optional<int> part_of_date(const std::string& cell) {
    const std::optional<double> number = weather_number(cell);
    if (!number || std::abs(*number) > 9999 || *number != std::floor(*number)) return std::nullopt;
    return static_cast<int>(*number);
}

void set_cells(WeatherRows& rows, std::span<const FormColumn> columns, const std::vector<std::string>& cells, int line,
               const WeatherReading& reading) {
    for (const FormColumn& column : columns) {
        if (reading.given.contains(quantity_of(column.measure))) continue;
        if (reading.light_only && !is_light(column.measure)) continue;
        const int number = static_cast<int>(column.cell + 1);
        if (column.cell >= cells.size()) {
            rows.miss(column.measure, number, "");
            continue;
        }
        const std::string& cell = cells[column.cell];
        const std::optional<double> value = weather_number(cell);
        if (!value && !cell.empty()) {
            rows.refuse(line, number, fmt::format("'{}' is '{}', which is no number", name_of(column.measure), cell));
        }
        if (!value || is_code(*value, column.missing)) {
            rows.miss(column.measure, number, cell);
        } else {
            rows.set(column.measure, *value * column.factor, number, cell);
        }
    }
}

double CalendarOfMonths::hours(const WeatherRows& rows, int line, int year, int month, int day, double at) {
    if (!days_of_date(is_leap_year(year) ? year : 2024, month, day) || !(at >= 0) || at > 24) {
        rows.refuse(line, 0, fmt::format("{}-{:02}-{:02} hour {:g} is no time", year, month, day, at));
    }
    if (first_month_ == 0) {
        first_year_ = year;
        first_month_ = month_ = month;
        first_day_ = day_ = day;
        return at;
    }
    if (month == month_ && day == day_) return 24.0 * static_cast<double>(days_) + at;
    const int last[] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool ends_february = month_ == 2 && day_ == 28 && month == 3 && day == 1;
    const bool is_next_day = month == month_ && day == day_ + 1;
    const bool begins_month = month == month_ % 12 + 1 && day == 1 && day_ == last[month_ - 1];
    if (!is_next_day && !begins_month && !ends_february) {
        rows.refuse(line, 0,
                    fmt::format("after {:02}-{:02} comes {:02}-{:02}: there is a gap in time, or rows are out of order",
                                month_, day_, month, day));
    }
    if (ends_february) has_leap_day_ = false;
    if (month == 2 && day == 29) has_leap_day_ = true;
    month_ = month;
    day_ = day;
    return 24.0 * static_cast<double>(++days_) + at;
}

int CalendarOfMonths::year() const {
    if (!has_leap_day_ || *has_leap_day_ == is_leap_year(first_year_)) return first_year_;
    return *has_leap_day_ ? 2024 : 2025;
}

}  // namespace espalier::environment
