#include "environment/given/weather/weather_table.h"

#include "environment/leaf/gas/air.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// What a measure can be, and what to say beyond.
struct Possible {
    const char* name;
    AirQuantity quantity;
    double lowest, highest;
    const char* too_low;
    const char* too_high;
};

const char* const too_much_light =
    "which is more than the sun can bring: check the unit in the header, or write NA where nothing was measured";
const char* const check_unit = "which no station measures: check the unit in the header, or write NA where nothing was";

// More light than the sun ever brings: clouds that reflect raise 1361 W m-2 above the air to 1900 (Gueymard 2017). The
// thermal offsets of dark pyranometers are not below -20 W m-2.
const std::array<Possible, measures>& all_possible() {
    using Q = AirQuantity;
    static const char* const dark = "below 0 by more than the offset of a sensor at night";
    static const char* const negative = "below 0";
    static const char* const percent = "more than 1: is it in %? Then write humidity (%) in the header";
    static const char* const moles =
        "but carbon dioxide is in umol per mol of air, 50 to 10000: 40 Pa at sea level are 400";
    static const std::array<Possible, measures> all{
        {{"temperature", Q::temperature, -95, 65, check_unit, check_unit},
         {"highest", Q::highest, -95, 65, check_unit, check_unit},
         {"lowest", Q::lowest, -95, 65, check_unit, check_unit},
         {"dew point", Q::humidity, -100, 50, check_unit, check_unit},
         {"humidity", Q::humidity, 0, 1.1, negative, percent},
         {"vapour pressure", Q::humidity, 0, 12, negative, check_unit},
         {"wind", Q::wind, 0, 120, "below 0: wind is a speed", check_unit},
         {"pressure", Q::pressure, 20, 120, check_unit, check_unit},
         {"global", Q::global, -20, 2000, dark, too_much_light},
         {"diffuse", Q::diffuse, -20, 2000, dark, too_much_light},
         {"direct", Q::diffuse, -20, 2000, dark, too_much_light},
         {"par", Q::par, -20, 5000, dark, too_much_light},
         {"diffuse", Q::diffuse, -20, 5000, dark, too_much_light},
         {"direct", Q::diffuse, -20, 5000, dark, too_much_light},
         {"diffuse share", Q::diffuse, 0, std::numeric_limits<double>::infinity(), negative, ""},
         {"rain", Q::rain, 0, 2000, negative, check_unit},
         {"co2", Q::carbon_dioxide, 50, 10000, moles, moles}}};
    return all;
}

const Possible& possible(Measure measure) {
    return all_possible()[static_cast<std::size_t>(measure)];
}

const char* name_of(AirQuantity quantity) {
    const auto& all = all_possible();
    return std::find_if(all.begin(), all.end(), [&](const Possible& one) { return one.quantity == quantity; })->name;
}

/// Whether a part of the light is more than all of it, by more than sensors differ: 10 % while the sun is low (Long &
/// Dutton 2002, BSRN Global Network recommended QC tests), and what loggers round.
bool exceeds(double part, double all) {
    return part > 1.1 * all + 5;
}

double usual_span(const std::vector<double>& hours) {
    std::vector<double> spans;
    for (std::size_t i = 1; i < hours.size(); ++i) spans.push_back(hours[i] - hours[i - 1]);
    if (spans.empty()) return 24;
    const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
    std::nth_element(spans.begin(), middle, spans.end());
    return *middle;
}

}  // namespace

const char* name_of(Measure measure) {
    return possible(measure).name;
}

AirQuantity quantity_of(Measure measure) {
    return possible(measure).quantity;
}

bool is_light(Measure measure) {
    return measure >= Measure::global && measure <= Measure::diffuse_share;
}

double WeatherTable::first() const {
    return std::min(hours.front(), has_mean_light ? from.front() : hours.front());
}

double WeatherTable::last() const {
    return std::max(hours.back(), has_mean_light ? to.back() : hours.back());
}

std::optional<long long> days_of_date(int year, int month, int day) {
    using namespace std::chrono;
    const year_month_day date(std::chrono::year(year), std::chrono::month(static_cast<unsigned>(std::max(0, month))),
                              std::chrono::day(static_cast<unsigned>(std::max(0, day))));
    if (!date.ok()) return std::nullopt;
    return sys_days(date).time_since_epoch().count();
}

int day_of_year(int year, int month, int day) {
    return static_cast<int>(days_of_date(year, month, day).value_or(0) - days_of_date(year, 1, 1).value_or(0)) + 1;
}

WeatherRows::WeatherRows(std::string path, const WeatherReading& reading)
    : path_(std::move(path)), reading_(reading), time_(reading.time.value_or(RowTime::instant)) {}

void WeatherRows::set_time(RowTime time, bool has_instant_air, double light_shift) {
    time_ = time;
    has_instant_air_ = has_instant_air;
    light_shift_ = light_shift;
}

void WeatherRows::refuse(int line, int column, const std::string& message) const {
    throw UserError({path_, line, column}, message);
}

void WeatherRows::warn(const Place& place, const std::string& message) const {
    if (reading_.warnings) reading_.warnings->push_back({Diagnostic::Severity::warning, place, message});
}

void WeatherRows::begin(double hours, int line) {
    hours_.push_back(hours);
    lines_.push_back(line);
    for (std::vector<double>& column : values_) column.push_back(not_measured);
}

void WeatherRows::set(Measure measure, double given, int column, const std::string& cell) {
    const Possible& known = possible(measure);
    const auto message = [&](const char* why) { return fmt::format("'{}' is {}, {}", known.name, cell, why); };
    if (given > known.highest && reading_.fill_hours) {
        holes_.push_back({hours_.size() - 1, measure, column, cell, message(known.too_high)});
        return;
    }
    if (given > known.highest) refuse(lines_.back(), column, message(known.too_high));
    if (given < known.lowest) refuse(lines_.back(), column, message(known.too_low));
    const bool is_whole_light = is_light(measure) || measure == Measure::humidity;
    const double most = measure == Measure::humidity ? 1 : known.highest;
    value(measure, hours_.size() - 1) = is_whole_light ? std::clamp(given, 0.0, most) : given;
}

void WeatherRows::miss(Measure measure, int column, const std::string& cell) {
    holes_.push_back({hours_.size() - 1, measure, column, cell, ""});
}

bool WeatherRows::has(Measure measure) const {
    const std::vector<double>& column = values_[static_cast<std::size_t>(measure)];
    return std::any_of(column.begin(), column.end(), [](double one) { return !std::isnan(one); });
}

void WeatherRows::require_rising_times() const {
    for (std::size_t i = 1; i < hours_.size(); ++i) {
        if (!(hours_[i] > hours_[i - 1])) {
            refuse(lines_[i], 0, "the time of this row is not after that of the row before");
        }
    }
}

/// Where rows are missing, there are rows without values, or they are refused.
void WeatherRows::lay_gaps() {
    const double usual = usual_span(hours_);
    std::vector<double> hours;
    std::vector<int> lines;
    std::vector<std::size_t> places;  // of the rows, among all
    for (std::size_t i = 0; i < hours_.size(); ++i) {
        if (i > 0) require_bridgeable(i, usual);
        while (i > 0 && hours_[i] - hours.back() > 1.5 * usual) {
            hours.push_back(hours.back() + usual);
            lines.push_back(lines_[i]);
        }
        places.push_back(hours.size());
        hours.push_back(hours_[i]);
        lines.push_back(lines_[i]);
    }
    for (std::vector<double>& column : values_) {
        std::vector<double> all(hours.size(), not_measured);
        for (std::size_t i = 0; i < places.size(); ++i) all[places[i]] = column[i];
        column = std::move(all);
    }
    for (Hole& hole : holes_) hole.row = places[hole.row];
    hours_ = std::move(hours);
    lines_ = std::move(lines);
}

void WeatherRows::require_bridgeable(std::size_t row, double usual) const {
    const double span = hours_[row] - hours_[row - 1];
    if (span <= 1.5 * usual || (reading_.fill_hours && span - usual <= *reading_.fill_hours + 1e-9)) return;
    refuse(lines_[row], 0,
           fmt::format("there is a gap in time: {:g} hours since the row before, where others are {:g} apart; give the "
                       "rows between, or write fill = \"linear\" and fill_hours = {:g}",
                       span, usual, std::ceil(span - usual)));
}

void WeatherRows::lay_times(WeatherTable& table) const {
    const std::size_t n = hours_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double before = i > 0 ? hours_[i] - hours_[i - 1] : hours_[1] - hours_[0];
        const double after = i + 1 < n ? hours_[i + 1] - hours_[i] : before;
        table.from.push_back(time_ == RowTime::span_ends ? hours_[i] - before : hours_[i]);
        table.to.push_back(time_ == RowTime::span_ends ? hours_[i] : hours_[i] + after);
        const bool is_middle = time_ != RowTime::instant && !has_instant_air_;
        table.hours.push_back(is_middle ? (table.from[i] + table.to[i]) / 2 : hours_[i]);
        table.light_hours.push_back(hours_[i] + light_shift_);
    }
    table.has_mean_light = time_ != RowTime::instant;
}

/// A column in % of which no value is above 1 holds shares.
void WeatherRows::refuse_shares_as_percent() const {
    const std::vector<double>& all = values_[static_cast<std::size_t>(Measure::humidity)];
    double most = 0;
    for (const double one : all) most = std::isnan(one) ? most : std::max(most, one);
    if (!has(Measure::humidity) || most > 0.011) return;
    refuse(lines_.front(), 0, "no value of 'humidity' is above 1 %: are they shares? Then write humidity (1)");
}

/// W/m2, by what was measured of sun and sky; NaN if nothing was.
double WeatherRows::diffuse_of(std::size_t row, double global, double par) const {
    const auto require_part = [&](Measure part, double all, const char* unit, const char* hint) {
        if (!exceeds(at(part, row), all)) return;
        refuse(lines_[row], 0,
               fmt::format("the {} light, {:g} {}, is more than all of it, {:g}{}", name_of(part), at(part, row), unit,
                           all, hint));
    };
    const char *const power = "W m-2", *const photons = "umol m-2 s-1";
    const char* const level = ": it must be that on level ground";
    require_part(Measure::diffuse, global, power, "");
    require_part(Measure::direct, global, power, level);
    require_part(Measure::diffuse_par, par, photons, "");
    require_part(Measure::direct_par, par, photons, level);
    const double given = at(Measure::diffuse_share, row);
    if (given > 1.1) {
        refuse(lines_[row], 0, fmt::format("the diffuse share is {:g}, more than 1: is it in %?", given));
    }
    const auto share = [&](Measure part, double all) { return all > 0 ? std::min(1.0, at(part, row) / all) : 0; };
    const auto is_measured = [&](Measure part) { return at(part, row) >= 0; };
    if (is_measured(Measure::diffuse)) return global * share(Measure::diffuse, global);
    if (is_measured(Measure::diffuse_par)) return global * share(Measure::diffuse_par, par);
    if (given >= 0) return global * std::min(1.0, given);
    if (is_measured(Measure::direct)) return global * (1 - share(Measure::direct, global));
    if (is_measured(Measure::direct_par)) return global * (1 - share(Measure::direct_par, par));
    return global > 0 ? not_measured : 0;
}

void WeatherRows::take_light(WeatherTable& table) {
    if (!has(Measure::global) && !has(Measure::par)) return;
    for (std::size_t i = 0; i < hours_.size(); ++i) {
        double global = at(Measure::global, i), par = at(Measure::par, i);
        if (std::isnan(global)) global = par / reading_.photons_of_global;
        if (std::isnan(par)) par = global * reading_.photons_of_global;
        table.of(AirQuantity::global).push_back(global);
        table.of(AirQuantity::par).push_back(par);
        table.of(AirQuantity::diffuse).push_back(diffuse_of(i, global, par));
    }
}

/// From the humidity, the vapour pressure or the dew point; of days at their mean temperature.
void WeatherRows::take_humidity(WeatherTable& table) const {
    if (!has(Measure::humidity) && !has(Measure::vapour) && !has(Measure::dew_point)) return;
    for (std::size_t i = 0; i < hours_.size(); ++i) {
        double share = at(Measure::humidity, i);
        double vapour = at(Measure::vapour, i);
        if (std::isnan(vapour)) vapour = leaf::saturation_pressure(at(Measure::dew_point, i));
        const double of_day = (at(Measure::highest, i) + at(Measure::lowest, i)) / 2;
        const double temperature = has(Measure::temperature) ? at(Measure::temperature, i) : of_day;
        if (std::isnan(share)) share = std::min(1.0, vapour / leaf::saturation_pressure(temperature));
        table.of(AirQuantity::humidity).push_back(share);
    }
}

void WeatherRows::take(WeatherTable& table, AirQuantity quantity, Measure measure) const {
    if (has(measure)) table.of(quantity) = values_[static_cast<std::size_t>(measure)];
}

void WeatherRows::refuse_hole(std::size_t row, AirQuantity quantity, const std::string& hint) const {
    for (const Hole& hole : holes_) {
        if (hole.row != row) continue;
        const AirQuantity other = quantity_of(hole.measure);
        const bool is_either = quantity == AirQuantity::global && other == AirQuantity::par;
        if (other != quantity && !is_either) continue;
        if (!hole.reason.empty()) refuse(lines_[row], hole.column, hole.reason + hint);
        refuse(lines_[row], hole.column,
               fmt::format("'{}' is '{}', which is no number that was measured: a series has no holes. Fill it, as "
                           "from the rows around it{}",
                           name_of(hole.measure), hole.cell, hint));
    }
    refuse(lines_[row], 0, fmt::format("'{}' is missing before this line{}", name_of(quantity), hint));
}

/// What to write where a station did not measure what a scene may give: rain, in most typical years.
std::string instead_of_column(AirQuantity quantity) {
    switch (quantity) {
        case AirQuantity::temperature:
        case AirQuantity::humidity:
        case AirQuantity::wind:
        case AirQuantity::pressure:
        case AirQuantity::rain:
            return fmt::format("; a number '{}' in the scene replaces the column", name_of(quantity));
        default:
            return "";
    }
}

/// Fills from `begin` on, and returns where the next value is.
std::size_t WeatherRows::fill_hole(std::vector<double>& values, const std::vector<double>& hours, std::size_t begin,
                                   AirQuantity quantity) const {
    std::size_t end = begin;
    while (end < values.size() && std::isnan(values[end])) ++end;
    const bool is_inside = begin > 0 && end < values.size();
    const double span = is_inside ? hours[end] - hours[begin - 1] - usual_span(hours) : 0;
    const std::string given = instead_of_column(quantity);
    if (!reading_.fill_hours) refuse_hole(begin, quantity, ", or write fill = \"linear\"" + given);
    if (!is_inside) {
        refuse_hole(begin, quantity, "; before the first and after the last value nothing can be filled" + given);
    }
    if (span > *reading_.fill_hours + 1e-9) {
        refuse_hole(
            begin, quantity,
            fmt::format("; it is missing for {:g} hours, and fill_hours is {:g}{}", span, *reading_.fill_hours, given));
    }
    const double before = values[begin - 1], step = hours[end] - hours[begin - 1];
    for (std::size_t i = begin; i < end; ++i) {
        values[i] = before + (values[end] - before) * (hours[i] - hours[begin - 1]) / step;
    }
    return end;
}

void WeatherRows::fill(WeatherTable& table) {
    for (std::size_t q = 0; q < air_quantities; ++q) {
        const auto quantity = static_cast<AirQuantity>(q);
        std::vector<double>& values = table.of(quantity);
        if (quantity == AirQuantity::diffuse) continue;
        std::size_t filled = 0, first = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!std::isnan(values[i])) continue;
            if (filled == 0) first = i;
            const std::size_t end = fill_hole(values, table.hours, i, quantity);
            filled += end - i;
            i = end;
        }
        if (filled == 0 || quantity == AirQuantity::par) continue;
        warn({path_, lines_[first], 0}, fmt::format("'{}' was missing in {}: filled linearly", name_of(quantity),
                                                    filled == 1 ? "this row" : fmt::format("{} rows", filled)));
    }
    std::vector<double>& diffuse = table.of(AirQuantity::diffuse);
    for (std::size_t i = 0; i < diffuse.size(); ++i) {
        if (std::isnan(diffuse[i]) && !(table.of(AirQuantity::global)[i] > 0)) diffuse[i] = 0;
    }
}

/// In the dark there is nothing to divide.
void WeatherRows::warn_of_light(const WeatherTable& table) const {
    if (!table.has(AirQuantity::global)) return;
    for (std::size_t m = 0; m < measures; ++m) {
        const auto measure = static_cast<Measure>(m);
        if (!is_light(measure)) continue;
        const Hole* first = nullptr;
        int count = 0;
        for (const Hole& hole : holes_) {
            const bool was_filled = std::isnan(at(Measure::global, hole.row)) && std::isnan(at(Measure::par, hole.row));
            if (hole.measure != measure || was_filled || !(table.of(AirQuantity::global)[hole.row] > 0)) continue;
            if (count++ == 0) first = &hole;
        }
        if (count == 0) continue;
        warn({path_, lines_[first->row], first->column},
             fmt::format("'{}' was not measured in {}, the first of which is '{}': there, light is taken from the "
                         "other columns",
                         name_of(measure), count == 1 ? "a cell" : fmt::format("{} cells", count), first->cell));
    }
}

WeatherTable WeatherRows::table() {
    WeatherTable table;
    table.source = path_;
    if (hours_.size() < 2) {
        refuse(0, 0,
               fmt::format("a series of {} needs a header and two rows at least",
                           reading_.light_only ? "light" : "weather"));
    }
    require_rising_times();
    lay_gaps();
    lay_times(table);
    refuse_shares_as_percent();
    take_light(table);
    take_humidity(table);
    take(table, AirQuantity::temperature, Measure::temperature);
    take(table, AirQuantity::highest, Measure::highest);
    take(table, AirQuantity::lowest, Measure::lowest);
    take(table, AirQuantity::wind, Measure::wind);
    take(table, AirQuantity::pressure, Measure::pressure);
    take(table, AirQuantity::rain, Measure::rain);
    take(table, AirQuantity::carbon_dioxide, Measure::carbon_dioxide);
    std::vector<double>& rain = table.of(AirQuantity::rain);
    for (std::size_t i = 0; i < rain.size() && has_amounts_; ++i) rain[i] /= table.to[i] - table.from[i];
    fill(table);
    warn_of_light(table);
    table.lines = lines_;
    return table;
}

}  // namespace espalier::environment
