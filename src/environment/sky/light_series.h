// Light as it was measured: a table in a file.
#pragma once

#include "espalier/base/error.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace espalier {
struct CsvRow;
}

namespace espalier::environment {

/// A row. NaN: not measured. All on level ground.
struct MeasuredLight {
    double hours = 0;    ///< since the midnight at which the series' first day begins
    double global = 0;   ///< W/m2, all wavelengths
    double diffuse = 0;  ///< W/m2
    double direct = 0;   ///< W/m2
    double par = 0;      ///< umol m-2 s-1
    int line = 0;        ///< of the file
};

/// A CSV file whose header names columns and units: "time (h)" or "date", and "global (W m-2)", "diffuse (W m-2)",
/// "direct (W m-2)", "par (umol m-2 s-1)"; other columns may stand beside them. Between its rows light changes evenly.
class LightSeries {
public:
    /// `photons` are the umol of PAR per joule, for PAR in W m-2. Throws UserError naming file and line for what is no
    /// number, below 0, without a known unit, or a gap in time.
    LightSeries(const std::filesystem::path& path, double photons);

    std::span<const MeasuredLight> rows() const { return rows_; }
    const std::filesystem::path& path() const { return path_; }
    /// The date of the first row as year and day of the year; 0 if the file has no dates.
    int year() const { return year_; }
    int day() const { return day_; }
    double first() const { return rows_.front().hours; }
    double last() const { return rows_.back().hours; }

    /// Between the neighbouring rows; `hours` lies between first and last.
    MeasuredLight at(double hours) const;

private:
    struct Column;
    std::vector<Column> columns_of(const CsvRow& header, double photons) const;
    void read_row(const CsvRow& read, std::span<const Column> columns);
    double read_date(const std::string& cell, int number, int column);
    void require_even_times() const;
    [[noreturn]] void refuse(int line, int column, const std::string& message) const;

    std::filesystem::path path_;
    std::vector<MeasuredLight> rows_;
    int year_ = 0, day_ = 0;
    long long first_midnight_ = 0;  ///< days of the calendar
};

}  // namespace espalier::environment
