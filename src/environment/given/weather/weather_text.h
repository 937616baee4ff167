// Lines of cells as the forms of weather stations have them: numbers with codes for what was not measured.
#pragma once

#include "environment/given/weather/weather_formats.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// Without carriage returns and empty lines.
std::vector<TextLine> weather_lines(const std::string& text);
/// Of a line, between commas.
std::vector<std::string> weather_cells(const std::string& text);
std::optional<double> weather_number(const std::string& cell);
/// The same if it is whole and can be part of a date.
std::optional<int> part_of_date(const std::string& cell);

/// A column of a form: where it stands, in which unit, and what stands there for no value.
struct FormColumn {
    Measure measure;
    std::size_t cell = 0;
    double factor = 1;
    double missing = -999;  ///< this number, and others as far from 0 on its side
};

/// Gives the cells of a line to the row that was begun.
void set_cells(WeatherRows& rows, std::span<const FormColumn> columns, const std::vector<std::string>& cells, int line,
               const WeatherReading& reading);

/// Hours since the midnight of the first day, of files whose years are put together of months of several: each day is
/// the one after that before, whatever its year says; 29 February may be left out.
class CalendarOfMonths {
public:
    /// `at`: hour of the day, up to 24. Throws UserError by `rows` for a date that does not follow.
    double hours(const WeatherRows& rows, int line, int year, int month, int day, double at);
    /// The first row's, or where it has another 29 February, a year that has the file's.
    int year() const;
    int day() const { return day_of_year(year(), first_month_, first_day_); }

private:
    int first_year_ = 0, first_month_ = 0, first_day_ = 0, month_ = 0, day_ = 0;
    long long days_ = 0;
    std::optional<bool> has_leap_day_;
};

}  // namespace espalier::environment
