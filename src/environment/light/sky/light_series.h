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

/// A row, all on level ground. What the file does not measure is taken from the other columns.
struct MeasuredLight {
    double hours = 0;    ///< since the midnight at which the series' first day begins
    double global = 0;   ///< W/m2, all wavelengths
    double diffuse = 0;  ///< W/m2; NaN: not measured
    double par = 0;      ///< umol m-2 s-1
    int line = 0;        ///< of the file
};

/// A CSV file whose header names columns and units: "time (h)" or "date", and "global (W m-2)", "diffuse (W m-2)",
/// "direct (W m-2)", "par (umol m-2 s-1)"; other columns may stand beside them. Between its rows light changes evenly.
/// Cells that stand for a missing value (CsvRow::is_missing) are measured by the other columns, or refused.
class LightSeries {
public:
    struct Photons {
        double of_par = 4.57;           ///< umol of PAR per joule of PAR
        double of_global = 0.5 * 4.57;  ///< and per joule of all wavelengths
    };

    /// Throws UserError naming file and line for what is no number, below -20 W m-2 (thermal offsets of dark
    /// pyranometers are not) or beyond the sun's light, without a known unit, or a gap in time. Warns of missing
    /// values.
    LightSeries(const std::filesystem::path& path, const Photons& photons, std::vector<Diagnostic>* warnings = nullptr);

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
    struct Cells;
    struct Column;
    struct Missing;
    std::vector<Column> columns_of(const CsvRow& header, std::vector<Diagnostic>* warnings) const;
    void read_row(const CsvRow& read, std::span<const Column> columns, std::vector<Missing>& missing);
    double read_value(const CsvRow& read, std::size_t at, const Column& column) const;
    double read_date(const std::string& cell, int number, int column);
    void add(const Cells& cells, int line);
    double diffuse_of(const Cells& cells, int line) const;
    void require_even_times() const;
    [[noreturn]] void refuse(int line, int column, const std::string& message) const;

    std::filesystem::path path_;
    Photons photons_;
    std::string separators_;
    std::vector<MeasuredLight> rows_;
    int year_ = 0, day_ = 0;
    long long first_midnight_ = 0;  ///< days of the calendar
};

}  // namespace espalier::environment
