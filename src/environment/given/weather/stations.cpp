// TMY3, PVGIS and NASA POWER.
#include "environment/given/weather/weather_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace espalier::environment {
namespace {

using Cells = std::vector<std::string>;

/// A column by the name that a form gives it.
struct NamedColumn {
    const char* name;
    Measure measure;
    double factor = 1;
    double missing = -999;
};

std::vector<FormColumn> columns_by_name(const Cells& header, std::span<const NamedColumn> named) {
    std::vector<FormColumn> columns;
    for (std::size_t i = 0; i < header.size(); ++i) {
        const auto known =
            std::find_if(named.begin(), named.end(), [&](const NamedColumn& one) { return header[i] == one.name; });
        if (known != named.end()) columns.push_back({known->measure, i, known->factor, known->missing});
    }
    return columns;
}

std::size_t place_of(const Cells& header, const std::string& name, const WeatherRows& rows, int line) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) rows.refuse(line, 0, fmt::format("this line names no column '{}'", name));
    return static_cast<std::size_t>(found - header.begin());
}

/// The whole number that stands in a text from `at` on.
int whole_at(const std::string& text, std::size_t at, std::size_t count, const WeatherRows& rows, int line) {
    const std::optional<int> number = at < text.size() ? part_of_date(text.substr(at, count)) : std::optional<int>();
    if (!number) rows.refuse(line, 0, fmt::format("'{}' is no date or time", text));
    return *number;
}

/// The cells of a row, as many as there are names.
Cells cells_of_row(const TextLine& line, const Cells& names, const WeatherRows& rows) {
    Cells cells = weather_cells(line.text);
    if (cells.size() >= names.size()) return cells;
    rows.refuse(line.number, 0, fmt::format("this row has {} cells, and the names {}", cells.size(), names.size()));
}

/// The number behind a word of a line.
std::optional<double> number_behind(const std::string& text, const std::string& word) {
    std::size_t begin = text.find(word);
    if (begin == std::string::npos) return std::nullopt;
    begin = text.find_first_of("-0123456789", begin + word.size());
    if (begin == std::string::npos) return std::nullopt;
    return weather_number(text.substr(begin, text.find_first_not_of("-.0123456789", begin) - begin));
}

/// A stamp in a year that is one with the others: TMY3 and PVGIS.
void finish(WeatherTable& table, const CalendarOfMonths& calendar, const GroundPlace& place,
            std::optional<double> height, double wind_height) {
    table.year = calendar.year();
    table.day = calendar.day();
    table.place = place;
    table.height = height;
    table.wind_height = wind_height;
}

constexpr std::array<NamedColumn, 8> tmy3_columns{{{"GHI (W/m^2)", Measure::global, 1, -9900},
                                                   {"DHI (W/m^2)", Measure::diffuse, 1, -9900},
                                                   {"Dry-bulb (C)", Measure::temperature, 1, -9900},
                                                   {"Dew-point (C)", Measure::dew_point, 1, -9900},
                                                   {"RHum (%)", Measure::humidity, 0.01, -9900},
                                                   {"Pressure (mbar)", Measure::pressure, 0.1, -9900},
                                                   {"Wspd (m/s)", Measure::wind, 1, -9900},
                                                   {"Lprecip depth (mm)", Measure::rain, 1, -9900}}};

constexpr std::array<NamedColumn, 6> pvgis_columns{{{"T2m", Measure::temperature},
                                                    {"RH", Measure::humidity, 0.01},
                                                    {"G(h)", Measure::global},
                                                    {"Gd(h)", Measure::diffuse},
                                                    {"WS10m", Measure::wind},
                                                    {"SP", Measure::pressure, 1e-3}}};

constexpr std::array<NamedColumn, 9> power_columns{{{"ALLSKY_SFC_SW_DWN", Measure::global},
                                                    {"ALLSKY_SFC_SW_DIFF", Measure::diffuse},
                                                    {"T2M", Measure::temperature},
                                                    {"T2MDEW", Measure::dew_point},
                                                    {"RH2M", Measure::humidity, 0.01},
                                                    {"WS10M", Measure::wind},
                                                    {"WS2M", Measure::wind},
                                                    {"PS", Measure::pressure},
                                                    {"PRECTOTCORR", Measure::rain}}};

/// Energy of an hour in W m-2, by the unit that the header says of POWER's radiation.
double power_of_hour(const std::string& line) {
    if (line.find("MJ/hr") != std::string::npos) return 1e6 / 3600;
    if (line.find("kW-hr") != std::string::npos || line.find("kWh") != std::string::npos) return 1000;
    return 1;
}

/// What POWER's header tells.
struct PowerHeader {
    GroundPlace place;
    std::optional<double> height;
    double of_radiation = 1;
    bool is_local = false;
};

PowerHeader power_header(std::span<const TextLine> lines) {
    PowerHeader header;
    for (const TextLine& line : lines) {
        const std::string& text = line.text;
        if (text.starts_with("Location")) {
            header.place.latitude = number_behind(text, "atitude").value_or(0);
            header.place.longitude = number_behind(text, "ongitude").value_or(0);
        }
        if (text.starts_with("Elevation")) header.height = number_behind(text, "=");
        if (text.starts_with("ALLSKY_SFC_SW_DWN")) header.of_radiation = power_of_hour(text);
        if (text.find("(LST)") != std::string::npos || text.find("in LST") != std::string::npos) header.is_local = true;
    }
    // Local solar time, in whole hours by the longitude.
    if (header.is_local) header.place.zone = std::round(header.place.longitude / 15);
    return header;
}

}  // namespace

WeatherTable read_tmy3(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading) {
    WeatherRows rows(path.string(), reading);
    rows.set_time(RowTime::span_ends, true);
    rows.set_rain_amounts();
    if (lines.size() < 3) rows.refuse(0, 0, "TMY3 has a line of the station, a line of names, and rows");
    const Cells station = weather_cells(lines[0].text), header = weather_cells(lines[1].text);
    std::array<double, 4> numbers{};  // zone, latitude, longitude, height
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = i + 3 < station.size() ? weather_number(station[i + 3]) : std::nullopt;
        if (!number) rows.refuse(1, static_cast<int>(i + 4), "the line of the station holds zone, place and height");
        numbers[i] = *number;
    }
    const std::vector<FormColumn> columns = columns_by_name(header, tmy3_columns);
    const std::size_t date = place_of(header, "Date (MM/DD/YYYY)", rows, lines[1].number);
    const std::size_t time = place_of(header, "Time (HH:MM)", rows, lines[1].number);
    CalendarOfMonths calendar;
    for (std::size_t i = 2; i < lines.size(); ++i) {
        const int line = lines[i].number;
        const Cells cells = cells_of_row(lines[i], header, rows);
        const auto whole = [&](std::size_t cell, std::size_t at, std::size_t count) {
            return whole_at(cells[cell], at, count, rows, line);
        };
        const double at = whole(time, 0, 2) + whole(time, 3, 2) / 60.0;
        rows.begin(calendar.hours(rows, line, whole(date, 6, 4), whole(date, 0, 2), whole(date, 3, 2), at), line);
        set_cells(rows, columns, cells, line, reading);
    }
    WeatherTable table = rows.table();
    finish(table, calendar, {numbers[1], numbers[2], numbers[0]}, numbers[3], 10);
    return table;
}

WeatherTable read_pvgis(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading) {
    WeatherRows rows(path.string(), reading);
    GroundPlace place;
    std::optional<double> height;
    double offset = 0;
    std::vector<FormColumn> columns;
    CalendarOfMonths calendar;
    for (const TextLine& line : lines) {
        const Cells cells = weather_cells(line.text);
        if (cells[0].starts_with("time")) {
            columns = columns_by_name(cells, pvgis_columns);
            rows.set_time(RowTime::instant, true, offset);
        } else if (columns.empty()) {
            place.latitude = number_behind(line.text, "Latitude (decimal degrees):").value_or(place.latitude);
            place.longitude = number_behind(line.text, "Longitude (decimal degrees):").value_or(place.longitude);
            if (const auto told = number_behind(line.text, "Elevation (m):")) height = told;
            offset = number_behind(line.text, "Irradiance Time Offset (h):").value_or(offset);
        } else {
            const std::string& stamp = cells[0];  // 20070101:0100; then come lines about the columns
            if (stamp.size() != 13 || stamp[8] != ':') break;
            const auto whole = [&](std::size_t at, std::size_t count) {
                return whole_at(stamp, at, count, rows, line.number);
            };
            const double at = whole(9, 2) + whole(11, 2) / 60.0;
            rows.begin(calendar.hours(rows, line.number, whole(0, 4), whole(4, 2), whole(6, 2), at), line.number);
            set_cells(rows, columns, cells, line.number, reading);
        }
    }
    if (rows.is_empty()) rows.refuse(0, 0, "this file of PVGIS has no rows behind a line that begins with 'time'");
    WeatherTable table = rows.table();
    finish(table, calendar, place, height, 10);
    return table;
}

WeatherTable read_nasa_power(const std::filesystem::path& path, TextLines lines, const WeatherReading& reading) {
    WeatherRows rows(path.string(), reading);
    rows.set_time(RowTime::span_begins);
    rows.set_rain_amounts();
    const auto end = std::find_if(lines.begin(), lines.end(),
                                  [](const TextLine& line) { return line.text.find("-END HEADER-") == 0; });
    if (end == lines.end() || end + 1 == lines.end()) rows.refuse(0, 0, "this file of POWER has no -END HEADER-");
    const PowerHeader told = power_header({lines.begin(), end});
    const Cells header = weather_cells((end + 1)->text);
    const int names = (end + 1)->number;
    std::vector<FormColumn> columns = columns_by_name(header, power_columns);
    for (FormColumn& column : columns) column.factor *= is_light(column.measure) ? told.of_radiation : 1;
    const std::size_t year = place_of(header, "YEAR", rows, names), month = place_of(header, "MO", rows, names);
    const std::size_t day = place_of(header, "DY", rows, names);
    if (std::find(header.begin(), header.end(), "HR") == header.end()) {
        rows.refuse(names, 0, "this file of POWER has days: ask for hours, in UTC");
    }
    const std::size_t hour = place_of(header, "HR", rows, names);
    const bool has_two_winds = std::count_if(columns.begin(), columns.end(), [](const FormColumn& column) {
                                   return column.measure == Measure::wind;
                               }) > 1;
    if (has_two_winds) {
        std::erase_if(columns, [&](const FormColumn& column) { return header[column.cell] == "WS2M"; });
    }
    const bool has_wind_at_10 = std::find(header.begin(), header.end(), "WS10M") != header.end();
    CalendarOfMonths calendar;
    for (auto line = end + 2; line != lines.end(); ++line) {
        const Cells cells = cells_of_row(*line, header, rows);
        const auto whole = [&](std::size_t cell) { return whole_at(cells[cell], 0, 4, rows, line->number); };
        rows.begin(calendar.hours(rows, line->number, whole(year), whole(month), whole(day), whole(hour)),
                   line->number);
        set_cells(rows, columns, cells, line->number, reading);
    }
    WeatherTable table = rows.table();
    finish(table, calendar, told.place, told.height, has_wind_at_10 ? 10 : 2);
    return table;
}

}  // namespace espalier::environment
