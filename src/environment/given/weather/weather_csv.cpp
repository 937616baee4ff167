// Tables whose header names columns and units.
#include "base/text.h"
#include "base/unit_text.h"
#include "environment/given/weather/series_clock.h"
#include "environment/given/weather/weather_formats.h"

#include <fmt/format.h>

#include <algorithm>

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

/// Reads one file.
class WeatherCsv {
public:
    WeatherCsv(const std::filesystem::path& path, const std::string& text, const WeatherReading& reading)
        : table_(path, text), reading_(reading), rows_(path.string(), reading) {}

    WeatherTable read() {
        for (const CsvRow& row : table_.rows()) {
            if (columns_.empty()) {
                read_header(row);
            } else {
                read_row(row);
            }
        }
        WeatherTable table = rows_.table();
        table.year = clock_->year();
        table.day = clock_->day();
        return table;
    }

private:
    struct Column {
        std::string name;
        bool is_value = false;  ///< of weather
        KnownUnit unit = {"", 1, {}};
    };

    void read_header(const CsvRow& header) {
        std::vector<KnownColumn> known = known_light(reading_.photons_of_par);
        for (KnownColumn& column : reading_.light_only ? std::vector<KnownColumn>() : known_air()) {
            known.push_back(std::move(column));
        }
        known.push_back({"time", {}});
        clock_ = SeriesClock::find(table_, header);
        for (const std::string& cell : header.cells) columns_.push_back(column_of(header, cell, known));
        require_columns(header);
    }

    Column column_of(const CsvRow& header, const std::string& cell, const std::vector<KnownColumn>& known) {
        const ColumnHead head = ColumnHead::of(cell);
        const std::string& name = head.name;
        const Place place = table_.place(header, columns_.size());
        if (name == "date" || name == "time") return {name};
        const auto one =
            std::find_if(known.begin(), known.end(), [&](const KnownColumn& each) { return name == each.name; });
        if (one == known.end()) {
            warn_of_unread(name, known, place);
            return {name};
        }
        const std::string unit = plain_unit(head.unit);
        const auto found = std::find_if(one->units.begin(), one->units.end(),
                                        [&](const KnownUnit& other) { return unit == plain_unit(other.unit); });
        if (found == one->units.end()) {
            std::vector<std::string> units;
            for (const KnownUnit& other : one->units) units.emplace_back(other.unit);
            const bool is_pressure = name == "co2" && head.unit == "Pa";
            refuse_unit(place, head, units, is_pressure ? " (40 Pa at sea level are 400 umol/mol)" : "");
        }
        if (reading_.given.contains(quantity_of(found->measure))) return {name};
        if (found->measure == Measure::rain && unit == "mm") rows_.set_rain_amounts();
        return {name, true, *found};
    }

    void warn_of_unread(const std::string& name, const std::vector<KnownColumn>& known, const Place& place) const {
        std::vector<std::string> names;
        for (const KnownColumn& one : known) names.emplace_back(one.name);
        if (!reading_.warnings || nearest_name(name, names).empty()) return;
        reading_.warnings->push_back({Diagnostic::Severity::warning, place,
                                      fmt::format("the column '{}' is not read{}", name, did_you_mean(name, names))});
    }

    void require_columns(const CsvRow& header) const {
        bool has_light = false, has_values = false, has_highest = false, has_lowest = false;
        for (const Column& column : columns_) {
            if (!column.is_value) continue;
            has_values = true;
            has_light = has_light || column.unit.measure == Measure::global || column.name == "par";
            has_highest = has_highest || column.unit.measure == Measure::highest;
            has_lowest = has_lowest || column.unit.measure == Measure::lowest;
        }
        const std::string found = fmt::format("in its cells, which {} separate", table_.separators());
        if (!clock_) {
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
        rows_.begin(clock_->hours(table_, row), row.line);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (columns_[i].is_value) read_value(row, i);
        }
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

    CsvRows table_;
    const WeatherReading& reading_;
    WeatherRows rows_;
    std::vector<Column> columns_;
    std::optional<SeriesClock> clock_;
};

}  // namespace

WeatherTable read_weather_csv(const std::filesystem::path& path, const std::string& text,
                              const WeatherReading& reading) {
    return WeatherCsv(path, text, reading).read();
}

}  // namespace espalier::environment
