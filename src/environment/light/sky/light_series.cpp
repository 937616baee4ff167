#include "environment/light/sky/light_series.h"

#include "base/csv_rows.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace espalier::environment {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A row as it stands in the file; NaN: not measured.
struct LightSeries::Cells {
    double hours = unknown, global = unknown, par = unknown;
    double diffuse = unknown, diffuse_par = unknown, diffuse_share = unknown, direct = unknown, direct_par = unknown;
};

/// What to do with a cell: a value of the row, times a factor.
struct LightSeries::Column {
    double Cells::*value = nullptr;  ///< null: not ours
    double factor = 1;
    bool is_date = false;
    std::string name = {};
    struct Known;

    static std::vector<Known> known(double photons_of_par);
    bool is_light() const { return value && value != &Cells::hours && value != &Cells::diffuse_share; }
    /// More than the sun ever brings: clouds that reflect raise 1361 W m-2 above the air to 1900 (Gueymard 2017).
    double most() const;
};

struct LightSeries::Missing {
    std::string column, cell = {};
    int line = 0, count = 0;
};

struct LightSeries::Column::Known {
    struct Unit {
        const char* unit;
        double factor;
        double Cells::*value;
    };
    const char* name;
    std::vector<Unit> units;
};

std::vector<LightSeries::Column::Known> LightSeries::Column::known(double photons_of_par) {
    using Units = std::vector<Known::Unit>;
    const auto power = [](double Cells::*value) {
        return Units{{"W m-2", 1, value}, {"W/m2", 1, value}, {"kW m-2", 1000, value}, {"kW/m2", 1000, value}};
    };
    const auto with_photons = [](Units units, double Cells::*value) {
        for (const Known::Unit& unit :
             Units{{"umol m-2 s-1", 1, value}, {"umol/m2/s", 1, value}, {"mol m-2 s-1", 1e6, value}}) {
            units.push_back(unit);
        }
        return units;
    };
    const auto share = &Cells::diffuse_share;
    Units diffuse = with_photons(power(&Cells::diffuse), &Cells::diffuse_par);
    diffuse.push_back({"1", 1, share});
    diffuse.push_back({"%", 0.01, share});
    Units par = with_photons({}, &Cells::par);
    par.push_back({"W m-2", photons_of_par, &Cells::par});
    par.push_back({"W/m2", photons_of_par, &Cells::par});
    const auto hours = &Cells::hours;
    return {{"time", {{"h", 1, hours}, {"min", 1.0 / 60, hours}, {"s", 1.0 / 3600, hours}, {"d", 24, hours}}},
            {"global", power(&Cells::global)},
            {"diffuse", diffuse},
            {"diffuse share", {{"1", 1, share}, {"", 1, share}, {"%", 0.01, share}}},
            {"direct", with_photons(power(&Cells::direct), &Cells::direct_par)},
            {"par", par}};
}

double LightSeries::Column::most() const {
    if (!is_light()) return std::numeric_limits<double>::infinity();
    const bool is_photons = value == &Cells::par || value == &Cells::diffuse_par || value == &Cells::direct_par;
    return is_photons ? 5000 : 2000;
}

namespace {

/// Whether a part of the light is more than all of it, by more than sensors differ: 10 % while the sun is low (Long &
/// Dutton 2002, BSRN Global Network recommended QC tests), and what loggers round.
bool exceeds(double part, double all) {
    return part > 1.1 * all + 5;
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

std::string trimmed(std::string text) {
    const char* const blanks = " \t\r";
    text.erase(0, std::min(text.find_first_not_of(blanks), text.size()));
    text.erase(text.find_last_not_of(blanks) + 1);
    return text;
}

std::string in_small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// "global (W m-2)" or "Global [W m-2]" as name, in small letters, and unit.
std::pair<std::string, std::string> name_and_unit(const std::string& cell) {
    const std::size_t open = cell.find_first_of("(["), close = cell.find_last_of(")]");
    if (open == std::string::npos || close == std::string::npos || close < open)
        return {in_small_letters(trimmed(cell)), ""};
    return {in_small_letters(trimmed(cell.substr(0, open))), trimmed(cell.substr(open + 1, close - open - 1))};
}

/// The whole number of so many digits at a place of the text.
std::optional<int> digits(const std::string& text, std::size_t at, std::size_t count) {
    if (at + count > text.size()) return std::nullopt;
    return whole_text_as<int>(std::string_view(text).substr(at, count));
}

}  // namespace

void LightSeries::refuse(int line, int column, const std::string& message) const {
    throw UserError({path_.string(), line, column}, message);
}

LightSeries::LightSeries(const std::filesystem::path& path, const Photons& photons, std::vector<Diagnostic>* warnings)
    : path_(path), photons_(photons) {
    const CsvRows table(path, true);
    separators_ = table.separators();
    std::vector<Column> columns;
    std::vector<Missing> missing;
    for (const CsvRow& row : table.rows()) {
        if (columns.empty()) {
            columns = columns_of(row, warnings);
            for (const Column& column : columns) missing.push_back({column.name});
        } else {
            read_row(row, columns, missing);
        }
    }
    if (rows_.size() < 2) refuse(0, 0, "a series of light needs a header and two rows at least");
    require_even_times();
    for (std::size_t i = 0; i < missing.size() && warnings; ++i) {
        if (missing[i].count == 0) continue;
        warnings->push_back(
            {Diagnostic::Severity::warning,
             {path_.string(), missing[i].line, static_cast<int>(i + 1)},
             fmt::format(
                 "'{}' was not measured in {}, the first of which is '{}': there, light is taken from the other "
                 "columns",
                 missing[i].column, missing[i].count == 1 ? "a cell" : fmt::format("{} cells", missing[i].count),
                 missing[i].cell)});
    }
}

std::vector<LightSeries::Column> LightSeries::columns_of(const CsvRow& header,
                                                         std::vector<Diagnostic>* warnings) const {
    const std::vector<Column::Known> known = Column::known(photons_.of_par);
    std::vector<Column> columns;
    bool has_time = false, has_light = false;
    for (const std::string& cell : header.cells) {
        const auto [name, written] = name_and_unit(cell);
        const std::string unit = plain_unit(written);
        Column column;
        column.name = name;
        column.is_date = name == "date";
        has_time = has_time || name == "date" || name == "time";
        has_light = has_light || name == "global" || name == "par";
        for (const Column::Known& one : known) {
            if (name != one.name) continue;
            const auto found = std::find_if(one.units.begin(), one.units.end(),
                                            [&](const Column::Known::Unit& other) { return unit == other.unit; });
            if (found == one.units.end()) {
                std::vector<std::string> units;
                for (const Column::Known::Unit& other : one.units) units.push_back(other.unit);
                refuse(header.line, static_cast<int>(columns.size() + 1),
                       fmt::format("the column '{}' has the unit '{}': write {} ({}), where the unit is one of: {}",
                                   name, written, name, units.front(), fmt::join(units, ", ")));
            }
            column.value = found->value;
            column.factor = found->factor;
        }
        columns.push_back(column);
        std::vector<std::string> names;
        for (const Column::Known& one : known) names.emplace_back(one.name);
        if (column.is_date || column.value || nearest_name(name, names).empty() || !warnings) continue;
        warnings->push_back({Diagnostic::Severity::warning,
                             {path_.string(), header.line, static_cast<int>(columns.size())},
                             fmt::format("the column '{}' is not read{}", name, did_you_mean(name, names))});
    }
    const std::string found = fmt::format("in its cells, which {} separate", separators_);
    if (!has_time) {
        refuse(header.line, 0,
               fmt::format("the header names no column 'time (h)' or 'date' {}: when was the light measured?", found));
    }
    if (!has_light) {
        refuse(header.line, 0,
               fmt::format("the header names neither 'global (W m-2)' nor 'par (umol m-2 s-1)' {}", found));
    }
    return columns;
}

double LightSeries::read_date(const std::string& cell, int number, int column) {
    const auto year = digits(cell, 0, 4), month = digits(cell, 5, 2), day = digits(cell, 8, 2);
    const auto hour = digits(cell, 11, 2), minute = digits(cell, 14, 2);
    const auto second = cell.size() > 16 ? digits(cell, 17, 2) : std::optional(0);
    using namespace std::chrono;
    const year_month_day date(std::chrono::year(year.value_or(0)),
                              std::chrono::month(static_cast<unsigned>(std::max(0, month.value_or(0)))),
                              std::chrono::day(static_cast<unsigned>(std::max(0, day.value_or(0)))));
    if (!year || !hour || !minute || !second || !date.ok() || *hour > 24 || *minute > 59 || *second > 60) {
        refuse(number, column, fmt::format("'{}' is no date: write 2025-06-21 13:30, civil time of the place", cell));
    }
    const long long midnight = sys_days(date).time_since_epoch().count();
    if (rows_.empty()) {
        first_midnight_ = midnight;
        year_ = *year;
        day_ = static_cast<int>(midnight - sys_days(date.year() / January / 1).time_since_epoch().count()) + 1;
    }
    return 24.0 * static_cast<double>(midnight - first_midnight_) + *hour + *minute / 60.0 + *second / 3600.0;
}

double LightSeries::read_value(const CsvRow& read, std::size_t at, const Column& column) const {
    constexpr double offset_of_dark_sensors = -20;
    const std::string& cell = read.cells[at];
    const int number = static_cast<int>(at + 1);
    const std::optional<double> value = read.number(at);
    if (!value) refuse(read.line, number, fmt::format("'{}' is '{}', which is no number", column.name, cell));
    const double measured = *value * column.factor;
    if (measured < (column.is_light() ? offset_of_dark_sensors : 0)) {
        refuse(read.line, number,
               fmt::format("'{}' is {}, below 0{}", column.name, cell,
                           column.is_light() ? " by more than the offset of a sensor at night" : ""));
    }
    if (measured > column.most()) {
        refuse(read.line, number,
               fmt::format("'{}' is {}, which is more than the sun can bring: check the unit in the header, or write "
                           "NA where nothing was measured",
                           column.name, cell));
    }
    return std::max(0.0, measured);
}

void LightSeries::read_row(const CsvRow& read, std::span<const Column> columns, std::vector<Missing>& missing) {
    if (read.cells.size() != columns.size()) {
        refuse(read.line, 0,
               fmt::format("this row has {} cells, and the header {}, which {} separate", read.cells.size(),
                           columns.size(), separators_));
    }
    Cells cells;
    std::vector<std::size_t> holes;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Column& column = columns[i];
        if (column.is_date) cells.hours = read_date(read.cells[i], read.line, static_cast<int>(i + 1));
        if (!column.value) continue;
        const std::optional<double> value = read.number(i);
        const bool is_code = column.is_light() && value && (*value == -99 || *value == -999);
        const bool is_time = column.value == &Cells::hours;  // 9999 is an hour as others
        if (is_time ? !value : is_code || read.is_missing(i)) {
            holes.push_back(i);
        } else {
            cells.*column.value = read_value(read, i, column);
        }
    }
    const bool is_timed = !std::isnan(cells.hours);
    for (const std::size_t hole : holes) {
        const Column& column = columns[hole];
        const bool is_needed = column.value == &Cells::hours || (std::isnan(cells.global) && std::isnan(cells.par));
        if (!is_needed) continue;
        refuse(read.line, static_cast<int>(hole + 1),
               fmt::format("'{}' is '{}', which is no number that was measured: a series has no holes. Fill it, as "
                           "from the rows around it",
                           column.name, read.cells[hole]));
    }
    if (!is_timed) refuse(read.line, 0, "this row has no time");
    add(cells, read.line);
    for (const std::size_t hole : holes) {
        if (!(rows_.back().global > 0)) continue;  // in the dark there is nothing to divide
        if (missing[hole].count++ > 0) continue;
        missing[hole].cell = read.cells[hole];
        missing[hole].line = read.line;
    }
}

void LightSeries::add(const Cells& cells, int line) {
    Cells all = cells;
    if (std::isnan(all.global)) all.global = all.par / photons_.of_global;
    if (std::isnan(all.par)) all.par = all.global * photons_.of_global;
    rows_.push_back({all.hours, all.global, diffuse_of(all, line), all.par, line});
}

/// W/m2, by what was measured of sun and sky; NaN if nothing was.
double LightSeries::diffuse_of(const Cells& cells, int line) const {
    const double global = cells.global, par = cells.par;
    const auto require_part = [&](double part, double all, const char* name, const char* unit, const char* hint) {
        if (!exceeds(part, all)) return;
        refuse(line, 0,
               fmt::format("the {} light, {:g} {}, is more than all of it, {:g}{}", name, part, unit, all, hint));
    };
    const char *const power = "W m-2", *const photons = "umol m-2 s-1";
    const char* const level = ": it must be that on level ground";
    require_part(cells.diffuse, global, "diffuse", power, "");
    require_part(cells.direct, global, "direct", power, level);
    require_part(cells.diffuse_par, par, "diffuse", photons, "");
    require_part(cells.direct_par, par, "direct", photons, level);
    if (cells.diffuse_share > 1.1) {
        refuse(line, 0, fmt::format("the diffuse share is {:g}, more than 1: is it in %?", cells.diffuse_share));
    }
    const auto share = [](double part, double all) { return all > 0 ? std::min(1.0, part / all) : 0; };
    if (cells.diffuse >= 0) return global * share(cells.diffuse, global);
    if (cells.diffuse_par >= 0) return global * share(cells.diffuse_par, par);
    if (cells.diffuse_share >= 0) return global * std::min(1.0, cells.diffuse_share);
    if (cells.direct >= 0) return global * (1 - share(cells.direct, global));
    if (cells.direct_par >= 0) return global * (1 - share(cells.direct_par, par));
    return global > 0 ? unknown : 0;
}

void LightSeries::require_even_times() const {
    std::vector<double> spans;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
        spans.push_back(rows_[i].hours - rows_[i - 1].hours);
        if (!(spans.back() > 0)) refuse(rows_[i].line, 0, "the time of this row is not after that of the row before");
    }
    std::vector<double> sorted = spans;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < spans.size(); ++i) {
        if (spans[i] <= 1.5 * usual) continue;
        refuse(rows_[i + 1].line, 0,
               fmt::format("there is a gap in time: {:g} hours since the row before, where others are {:g} apart",
                           spans[i], usual));
    }
    const auto is_dark = [](const MeasuredLight& row) { return !(row.global > 0) && !(row.par > 0); };
    if (std::all_of(rows_.begin(), rows_.end(), is_dark)) refuse(0, 0, "there is no light in any row");
}

MeasuredLight LightSeries::at(double hours) const {
    const auto after = std::lower_bound(rows_.begin() + 1, rows_.end() - 1, hours,
                                        [](const MeasuredLight& row, double at) { return row.hours < at; });
    const MeasuredLight &a = *(after - 1), &b = *after;
    const double t = std::clamp((hours - a.hours) / (b.hours - a.hours), 0.0, 1.0);
    const auto between = [&](double MeasuredLight::*value) { return (1 - t) * (a.*value) + t * (b.*value); };
    return {hours, between(&MeasuredLight::global), between(&MeasuredLight::diffuse), between(&MeasuredLight::par),
            a.line};
}

}  // namespace espalier::environment
