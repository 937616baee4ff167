// Tables whose header names columns and units.
#include "base/csv_rows.h"
#include "base/number.h"
#include "base/text.h"
#include "environment/given/weather/weather_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace espalier::environment {
namespace {

struct KnownUnit {
    const char* unit;
    double factor;
    Measure measure;
    double offset = 0;  ///< added behind the factor
};

struct KnownColumn {
    const char* name;
    std::vector<KnownUnit> units;
};

using Units = std::vector<KnownUnit>;

Units power(Measure measure) {
    return {{"W m-2", 1, measure}, {"W/m2", 1, measure}, {"kW m-2", 1000, measure}, {"kW/m2", 1000, measure}};
}

Units with_photons(Units units, Measure measure) {
    for (const KnownUnit& unit :
         Units{{"umol m-2 s-1", 1, measure}, {"umol/m2/s", 1, measure}, {"mol m-2 s-1", 1e6, measure}}) {
        units.push_back(unit);
    }
    return units;
}

std::vector<KnownColumn> known_light(double photons_of_par) {
    const Measure share = Measure::diffuse_share;
    Units diffuse = with_photons(power(Measure::diffuse), Measure::diffuse_par);
    diffuse.push_back({"1", 1, share});
    diffuse.push_back({"%", 0.01, share});
    Units par = with_photons({}, Measure::par);
    par.push_back({"W m-2", photons_of_par, Measure::par});
    par.push_back({"W/m2", photons_of_par, Measure::par});
    Units global = power(Measure::global);
    const double daily = 1e6 / 86400;
    for (const char* unit : {"MJ m-2 d-1", "MJ/m2/d", "MJ m-2 day-1"}) global.push_back({unit, daily, Measure::global});
    return {{"global", global},
            {"diffuse", diffuse},
            {"diffuse share", {{"1", 1, share}, {"", 1, share}, {"%", 0.01, share}}},
            {"direct", with_photons(power(Measure::direct), Measure::direct_par)},
            {"par", par}};
}

std::vector<KnownColumn> known_air() {
    const auto degrees = [](Measure measure) {
        return Units{{"degC", 1, measure},
                     {"C", 1, measure},
                     {"\xC2\xB0"
                      "C",
                      1, measure},
                     {"K", 1, measure, -273.15}};
    };
    const auto pascal = [](Measure measure) {
        return Units{{"kPa", 1, measure}, {"hPa", 0.1, measure}, {"mbar", 0.1, measure}, {"Pa", 1e-3, measure}};
    };
    const auto humidity = Units{{"%", 0.01, Measure::humidity}, {"1", 1, Measure::humidity}};
    return {{"temperature", degrees(Measure::temperature)},
            {"highest", degrees(Measure::highest)},
            {"tmax", degrees(Measure::highest)},
            {"lowest", degrees(Measure::lowest)},
            {"tmin", degrees(Measure::lowest)},
            {"dew point", degrees(Measure::dew_point)},
            {"humidity", humidity},
            {"relative humidity", humidity},
            {"vapour pressure", pascal(Measure::vapour)},
            {"wind", {{"m/s", 1, Measure::wind}, {"m s-1", 1, Measure::wind}, {"km/h", 1 / 3.6, Measure::wind}}},
            {"pressure", pascal(Measure::pressure)},
            {"rain",
             {{"mm", 1, Measure::rain},
              {"mm/h", 1, Measure::rain},
              {"mm h-1", 1, Measure::rain},
              {"mm/d", 1.0 / 24, Measure::rain},
              {"mm d-1", 1.0 / 24, Measure::rain}}},
            {"co2",
             {{"umol/mol", 1, Measure::carbon_dioxide},
              {"umol mol-1", 1, Measure::carbon_dioxide},
              {"ppm", 1, Measure::carbon_dioxide}}}};
}

Units units_of_time() {
    return {{"h", 1, {}}, {"min", 1.0 / 60, {}}, {"s", 1.0 / 3600, {}}, {"d", 24, {}}};
}

/// The unit with the letters that stand on every keyboard: "umol m-2 s-1" of "\u00b5mol m\u207b\u00b2 s\u207b\u00b9".
std::string plain_unit(std::string unit) {
    static const std::vector<std::pair<std::string, std::string>> letters{
        {"\xC2\xB5", "u"}, {"\xCE\xBC", "u"}, {"\xE2\x81\xBB", "-"}, {"\xC2\xB2", "2"},
        {"\xC2\xB9", "1"}, {"\xC2\xB7", " "}, {"\xE2\x88\x92", "-"}, {"^", ""}};
    for (const auto& [from, to] : letters) {
        for (std::size_t at = unit.find(from); at != std::string::npos; at = unit.find(from, at)) {
            unit.replace(at, from.size(), to);
        }
    }
    return unit;
}

/// "global (W m-2)" or "Global [W m-2]" as name, in small letters, and unit.
std::pair<std::string, std::string> name_and_unit(const std::string& cell) {
    const std::size_t open = cell.find_first_of("(["), close = cell.find_last_of(")]");
    if (open == std::string::npos || close == std::string::npos || close < open)
        return {in_small_letters(trimmed(cell)), ""};
    return {in_small_letters(trimmed(cell.substr(0, open))),
            std::string(trimmed(cell.substr(open + 1, close - open - 1)))};
}

/// The whole number of so many digits at a place of the text.
std::optional<int> digits(const std::string& text, std::size_t at, std::size_t count) {
    if (at + count > text.size()) return std::nullopt;
    return whole_text_as<int>(std::string_view(text).substr(at, count));
}

/// Reads one file.
class WeatherCsv {
public:
    WeatherCsv(const std::filesystem::path& path, const std::string& text, const WeatherReading& reading)
        : table_(path, text, true), reading_(reading), rows_(path.string(), reading) {}

    WeatherTable read() {
        for (const CsvRow& row : table_.rows()) {
            if (columns_.empty()) {
                read_header(row);
            } else {
                read_row(row);
            }
        }
        WeatherTable table = rows_.table();
        table.year = year_;
        table.day = day_;
        return table;
    }

private:
    struct Column {
        std::string name;
        enum class Kind { other, time, date, value } kind = Kind::other;
        KnownUnit unit = {"", 1, {}};
    };

    void read_header(const CsvRow& header) {
        std::vector<KnownColumn> known = known_light(reading_.photons_of_par);
        for (KnownColumn& column : reading_.light_only ? std::vector<KnownColumn>() : known_air()) {
            known.push_back(std::move(column));
        }
        known.push_back({"time", units_of_time()});
        for (const std::string& cell : header.cells) columns_.push_back(column_of(header, cell, known));
        require_columns(header);
    }

    Column column_of(const CsvRow& header, const std::string& cell, const std::vector<KnownColumn>& known) {
        const auto [name, written] = name_and_unit(cell);
        const int number = static_cast<int>(columns_.size() + 1);
        if (name == "date") return {name, Column::Kind::date};
        const auto one = std::find_if(known.begin(), known.end(),
                                      [&name = name](const KnownColumn& each) { return name == each.name; });
        if (one == known.end()) {
            warn_of_unread(name, known, {table_.place(header).file, header.line, number});
            return {name};
        }
        const std::string unit = plain_unit(written);
        const auto found = std::find_if(one->units.begin(), one->units.end(),
                                        [&](const KnownUnit& other) { return unit == plain_unit(other.unit); });
        if (found == one->units.end()) refuse_unit(header.line, number, name, written, one->units);
        if (name == "time") return {name, Column::Kind::time, *found};
        if (reading_.given.contains(quantity_of(found->measure))) return {name};
        if (found->measure == Measure::rain && unit == "mm") rows_.set_rain_amounts();
        return {name, Column::Kind::value, *found};
    }

    [[noreturn]] void refuse_unit(int line, int number, const std::string& name, const std::string& written,
                                  const Units& known) const {
        std::vector<std::string> units;
        for (const KnownUnit& other : known) units.emplace_back(other.unit);
        const std::string pascal = name == "co2" && written == "Pa" ? " (40 Pa at sea level are 400 umol/mol)" : "";
        rows_.refuse(line, number,
                     fmt::format("the column '{}' has the unit '{}': write {} ({}), where the unit is one of: {}{}",
                                 name, written, name, units.front(), fmt::join(units, ", "), pascal));
    }

    void warn_of_unread(const std::string& name, const std::vector<KnownColumn>& known, const Place& place) const {
        std::vector<std::string> names;
        for (const KnownColumn& one : known) names.emplace_back(one.name);
        if (!reading_.warnings || nearest_name(name, names).empty()) return;
        reading_.warnings->push_back({Diagnostic::Severity::warning, place,
                                      fmt::format("the column '{}' is not read{}", name, did_you_mean(name, names))});
    }

    void require_columns(const CsvRow& header) const {
        bool has_time = false, has_light = false, has_values = false, has_highest = false, has_lowest = false;
        for (const Column& column : columns_) {
            has_time = has_time || column.kind == Column::Kind::time || column.kind == Column::Kind::date;
            if (column.kind != Column::Kind::value) continue;
            has_values = true;
            has_light = has_light || column.unit.measure == Measure::global || column.name == "par";
            has_highest = has_highest || column.unit.measure == Measure::highest;
            has_lowest = has_lowest || column.unit.measure == Measure::lowest;
        }
        const std::string found = fmt::format("in its cells, which {} separate", table_.separators());
        if (!has_time) {
            rows_.refuse(header.line, 0,
                         fmt::format("the header names no column 'time (h)' or 'date' {}: when was {} measured?", found,
                                     reading_.light_only ? "the light" : "this"));
        }
        if (reading_.light_only && !has_light) {
            rows_.refuse(header.line, 0,
                         fmt::format("the header names neither 'global (W m-2)' nor 'par (umol m-2 s-1)' {}", found));
        }
        if (!has_values) {
            rows_.refuse(header.line, 0,
                         fmt::format("the header names no column of weather {}: write 'temperature (degC)', 'humidity "
                                     "(%)', 'wind (m/s)', 'global (W m-2)', 'rain (mm)' and the like",
                                     found));
        }
        if (has_highest != has_lowest) {
            rows_.refuse(header.line, 0, "days need both 'highest (degC)' and 'lowest (degC)'");
        }
    }

    void read_row(const CsvRow& row) {
        if (row.cells.size() != columns_.size()) {
            rows_.refuse(row.line, 0,
                         fmt::format("this row has {} cells, and the header {}, which {} separate", row.cells.size(),
                                     columns_.size(), table_.separators()));
        }
        rows_.begin(hours_of(row), row.line);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (columns_[i].kind == Column::Kind::value) read_value(row, i);
        }
    }

    double hours_of(const CsvRow& row) {
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const int number = static_cast<int>(i + 1);
            if (columns_[i].kind == Column::Kind::date) return read_date(row.cells[i], row.line, number);
            if (columns_[i].kind != Column::Kind::time) continue;
            const std::optional<double> hours = row.number(i);
            if (!hours)
                rows_.refuse(row.line, number, fmt::format("the time is '{}', which is no number", row.cells[i]));
            if (*hours < 0) rows_.refuse(row.line, number, fmt::format("the time is {}, below 0", row.cells[i]));
            return *hours * columns_[i].unit.factor;
        }
        return 0;
    }

    void read_value(const CsvRow& row, std::size_t i) {
        const KnownUnit& unit = columns_[i].unit;
        const int number = static_cast<int>(i + 1);
        const std::optional<double> value = row.number(i);
        const bool is_code = value && (*value == -99 || *value == -999);
        if (is_code || row.is_missing(i)) return rows_.miss(unit.measure, number, row.cells[i]);
        if (!value) {
            rows_.refuse(row.line, number,
                         fmt::format("'{}' is '{}', which is no number", columns_[i].name, row.cells[i]));
        }
        rows_.set(unit.measure, *value * unit.factor + unit.offset, number, row.cells[i]);
    }

    double read_date(const std::string& cell, int line, int column) {
        const bool is_day = cell.size() == 10;
        const auto year = digits(cell, 0, 4), month = digits(cell, 5, 2), day = digits(cell, 8, 2);
        const auto hour = is_day ? std::optional(0) : digits(cell, 11, 2);
        const auto minute = is_day ? std::optional(0) : digits(cell, 14, 2);
        const auto second = cell.size() > 16 ? digits(cell, 17, 2) : std::optional(0);
        const auto midnight = days_of_date(year.value_or(0), month.value_or(0), day.value_or(0));
        if (!year || !hour || !minute || !second || !midnight || *hour > 24 || *minute > 59 || *second > 60) {
            rows_.refuse(line, column,
                         fmt::format("'{}' is no date: write 2025-06-21 13:30, civil time of the place", cell));
        }
        if (rows_.is_empty()) {
            first_midnight_ = *midnight;
            year_ = *year;
            day_ = day_of_year(*year, *month, *day);
        }
        return 24.0 * static_cast<double>(*midnight - first_midnight_) + *hour + *minute / 60.0 + *second / 3600.0;
    }

    CsvRows table_;
    const WeatherReading& reading_;
    WeatherRows rows_;
    std::vector<Column> columns_;
    int year_ = 0, day_ = 0;
    long long first_midnight_ = 0;
};

}  // namespace

WeatherTable read_weather_csv(const std::filesystem::path& path, const std::string& text,
                              const WeatherReading& reading) {
    return WeatherCsv(path, text, reading).read();
}

}  // namespace espalier::environment
