#include "environment/given/weather/weather_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::environment {
namespace {

constexpr std::size_t fewest_epw_cells = 22;  // up to the wind's speed; rain came later

// Numbers of fields and codes as EnergyPlus documents them.
constexpr std::array<FormColumn, 8> epw_columns{{{Measure::temperature, 6, 1, 99.9},
                                                 {Measure::dew_point, 7, 1, 99.9},
                                                 {Measure::humidity, 8, 0.01, 999},
                                                 {Measure::pressure, 9, 1e-3, 999999},
                                                 {Measure::global, 13, 1, 9999},
                                                 {Measure::diffuse, 15, 1, 9999},
                                                 {Measure::wind, 21, 1, 999},
                                                 {Measure::rain, 33, 1, 999}}};

double number_of_head(const std::vector<std::string>& cells, std::size_t i, const WeatherRows& rows, int line) {
    const std::optional<double> number = i < cells.size() ? weather_number(cells[i]) : std::nullopt;
    if (!number) rows.refuse(line, static_cast<int>(i + 1), "LOCATION must hold latitude, longitude, zone and height");
    return *number;
}

}  // namespace

WeatherTable read_epw(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading) {
    WeatherRows rows(path.string(), reading);
    rows.set_time(RowTime::span_ends, true);
    rows.set_rain_amounts();
    CalendarOfMonths calendar;
    GroundPlace place;
    double height = 0, records = 1;
    bool has_begun = false;
    for (const TextLine& line : lines) {
        const std::vector<std::string> cells = weather_cells(line.text);
        if (cells[0] == "LOCATION") {
            const auto number = [&](std::size_t i) { return number_of_head(cells, i, rows, line.number); };
            place = {number(6), number(7), number(8)};
            height = number(9);
        }
        if (cells[0] == "DATA PERIODS") {
            has_begun = true;
            records = cells.size() > 2 ? weather_number(cells[2]).value_or(1) : 1;
            if (records > 1) {
                rows.warn({path.string(), line.number, 3},
                          fmt::format("this EPW has {:g} records an hour: their radiation is taken as the mean of the "
                                      "record in W/m2; where it is the sum in Wh/m2, all light is {:g} times too weak",
                                      records, records));
            }
            continue;
        }
        if (!has_begun) continue;
        if (cells.size() < fewest_epw_cells) {
            rows.refuse(line.number, 0,
                        fmt::format("this row has {} cells, where EPW has 35: is the file cut off?", cells.size()));
        }
        std::array<int, 5> date{};  // year, month, day, hour, minute
        for (std::size_t i = 0; i < date.size(); ++i) {
            const std::optional<int> number = part_of_date(cells[i]);
            if (!number) {
                rows.refuse(line.number, static_cast<int>(i + 1), fmt::format("'{}' is no part of a date", cells[i]));
            }
            date[i] = *number;
        }
        const double part = records > 1 && date[4] > 0 ? date[4] / 60.0 : 1;
        rows.begin(calendar.hours(rows, line.number, date[0], date[1], date[2], date[3] - 1 + part), line.number);
        set_cells(rows, epw_columns, cells, line.number, reading);
    }
    if (rows.is_empty()) rows.refuse(0, 0, "this EPW has no rows behind 'DATA PERIODS'");
    WeatherTable table = rows.table();
    table.year = calendar.year();
    table.day = calendar.day();
    table.place = place;
    table.height = height;
    table.wind_height = 10;
    return table;
}

}  // namespace espalier::environment
