// Light as a table of weather has it.
#pragma once

#include "environment/given/weather/weather_table.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// A row, all on level ground. What the file does not measure is taken from the other columns.
struct MeasuredLight {
    double hours = 0;    ///< since the midnight at which the series' first day begins; the middle of a span
    double global = 0;   ///< W/m2, all wavelengths
    double diffuse = 0;  ///< W/m2; NaN: not measured
    double par = 0;      ///< umol m-2 s-1
    int line = 0;        ///< of the file
};

/// Between rows that are moments light changes evenly; rows that are spans have their mean all the time.
class LightSeries {
public:
    /// Throws UserError where the table has no light.
    explicit LightSeries(std::shared_ptr<const WeatherTable> table);

    std::span<const MeasuredLight> rows() const { return rows_; }
    const std::string& source() const { return table_->source; }
    /// The date of the first row as year and day of the year; 0 if the file has no dates.
    int year() const { return table_->year; }
    int day() const { return table_->day; }
    double first() const { return first_; }  ///< hours
    double last() const { return last_; }
    /// When light begins to change otherwise, rising.
    std::span<const double> breaks() const { return breaks_; }

    /// `hours` lies between first and last.
    MeasuredLight at(double hours) const;

private:
    std::shared_ptr<const WeatherTable> table_;
    std::vector<MeasuredLight> rows_;
    std::vector<double> breaks_;
    double first_ = 0, last_ = 0;
};

}  // namespace espalier::environment
