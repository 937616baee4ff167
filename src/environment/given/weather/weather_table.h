// Weather as a table: one series of time with columns in fixed units, whatever file it comes from.
#pragma once

#include "espalier/base/error.h"

#include "environment/light/sun/sun.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::environment {

/// Degrees Celsius, share from 0 to 1, m s-1, kPa; W m-2 of all wavelengths on level ground, umol m-2 s-1; mm h-1, umol
/// mol-1. The diffuse light is NaN where nobody measured it.
enum class AirQuantity : std::uint8_t {
    temperature,
    highest,  ///< temperature of the day
    lowest,
    humidity,
    wind,
    pressure,
    global,
    diffuse,
    par,
    rain,
    carbon_dioxide
};
inline constexpr std::size_t air_quantities = 11;

/// Which time a row speaks of. Of spans, the air's values belong to the middle, or to the stamp itself.
enum class RowTime : std::uint8_t {
    instant,      ///< all values are of the stamp's moment; rain falls until the next row
    span_begins,  ///< values are means from the stamp to the next row
    span_ends     ///< values are means from the row before to the stamp
};

struct WeatherTable {
    std::string source;               ///< the file
    std::vector<double> hours;        ///< of the air's values, since the midnight at which the first day begins
    std::vector<double> from, to;     ///< of the means
    std::vector<double> light_hours;  ///< of the light, where it was measured at moments
    std::array<std::vector<double>, air_quantities> values;  ///< empty: not in the file
    std::vector<int> lines;                                  ///< of the file
    bool has_mean_light = false;                             ///< over the spans, else at moments
    int year = 0, day = 0;  ///< of the first row; the day counts from 1 on 1 January; 0: the file has no dates
    std::optional<GroundPlace> place;
    std::optional<double> height;       ///< above the sea, m
    std::optional<double> wind_height;  ///< above the ground, m

    const std::vector<double>& of(AirQuantity quantity) const { return values[static_cast<std::size_t>(quantity)]; }
    std::vector<double>& of(AirQuantity quantity) { return values[static_cast<std::size_t>(quantity)]; }
    bool has(AirQuantity quantity) const { return !of(quantity).empty(); }
    std::size_t size() const { return hours.size(); }
    double first() const;  ///< hours
    double last() const;
};

/// How a table is read.
struct WeatherReading {
    bool light_only = false;                ///< other columns are not looked at
    std::set<AirQuantity> given;            ///< by the scene: not looked at either
    std::optional<double> fill_hours;       ///< missing values over so many hours are filled linearly; none: refused
    std::optional<RowTime> time;            ///< of a CSV; others say it themselves
    double photons_of_par = 4.57;           ///< umol per joule of PAR
    double photons_of_global = 0.5 * 4.57;  ///< and per joule of all wavelengths
    std::vector<Diagnostic>* warnings = nullptr;
};

/// What a cell may be measured as. The units are those of AirQuantity; vapour pressure in kPa.
enum class Measure : std::uint8_t {
    temperature,
    highest,
    lowest,
    dew_point,
    humidity,
    vapour,
    wind,
    pressure,
    global,
    diffuse,
    direct,
    par,
    diffuse_par,
    direct_par,
    diffuse_share,
    rain,
    carbon_dioxide
};
inline constexpr std::size_t measures = 17;
const char* name_of(Measure measure);
/// The column that it becomes.
AirQuantity quantity_of(Measure measure);
bool is_light(Measure measure);

/// Rows as readers of files give them, one after the other; then the table.
class WeatherRows {
public:
    /// `amounts`: rain is mm of a row's span, not mm h-1.
    WeatherRows(std::string path, const WeatherReading& reading);

    void set_time(RowTime time, bool has_instant_air = false, double light_shift = 0);
    void set_rain_amounts() { has_amounts_ = true; }

    void begin(double hours, int line);
    /// A value of the row that was begun. `cell` is what the file has at this column, counted from 1. Throws UserError
    /// for what cannot be; above what is possible is missing where missing values are filled.
    void set(Measure measure, double value, int column, const std::string& cell);
    void miss(Measure measure, int column, const std::string& cell);
    bool is_empty() const { return hours_.empty(); }
    double last_hours() const { return hours_.back(); }

    /// The whole, checked, filled and converted. Throws UserError naming line and column.
    WeatherTable table();

    [[noreturn]] void refuse(int line, int column, const std::string& message) const;
    void warn(const Place& place, const std::string& message) const;

private:
    struct Hole {
        std::size_t row;
        Measure measure;
        int column;
        std::string cell, reason;
    };
    double& value(Measure measure, std::size_t row) { return values_[static_cast<std::size_t>(measure)][row]; }
    double at(Measure measure, std::size_t row) const { return values_[static_cast<std::size_t>(measure)][row]; }
    bool has(Measure measure) const;

    void require_rising_times() const;
    void lay_gaps();
    void require_bridgeable(std::size_t row, double usual) const;
    void lay_times(WeatherTable& table) const;
    void refuse_shares_as_percent() const;
    void take_light(WeatherTable& table);
    double diffuse_of(std::size_t row, double global, double par) const;
    void take_humidity(WeatherTable& table) const;
    void take(WeatherTable& table, AirQuantity quantity, Measure measure) const;
    void fill(WeatherTable& table);
    std::size_t fill_hole(std::vector<double>& values, const std::vector<double>& hours, std::size_t begin,
                          AirQuantity quantity) const;
    [[noreturn]] void refuse_hole(std::size_t row, AirQuantity quantity, const std::string& hint) const;
    void warn_of_light(const WeatherTable& table) const;

    std::string path_;
    WeatherReading reading_;
    RowTime time_ = RowTime::instant;
    bool has_instant_air_ = false, has_amounts_ = false;
    double light_shift_ = 0;
    std::vector<double> hours_;
    std::vector<int> lines_;
    std::array<std::vector<double>, measures> values_;
    std::vector<Hole> holes_;
};

/// Reads a CSV whose header names columns and units, or what weather_formats.h knows by its first line. Throws
/// UserError.
WeatherTable read_weather_file(const std::filesystem::path& path, const WeatherReading& reading);

/// Whole days since 1 January 1970 of a date, if there is one.
std::optional<long long> days_of_date(int year, int month, int day);
/// From 1 on 1 January.
int day_of_year(int year, int month, int day);

}  // namespace espalier::environment
