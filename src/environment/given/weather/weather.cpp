#include "environment/given/weather/weather.h"

#include "espalier/base/math.h"

#include "base/text.h"
#include "environment/exchange/changing_settings.h"
#include "environment/given/weather/course_of_day.h"
#include "environment/given/weather/day_of_sun.h"
#include "environment/leaf/gas/reference_evaporation.h"
#include "environment/leaf/gas/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

using Q = AirQuantity;

/// Allen et al. 1998, eq. 47: from the wind at a height to that at 2 m over a lawn.
double wind_factor(double height) {
    return height == 2 ? 1 : 4.87 / math::log(67.8 * height - 5.42);
}

RowTime row_time(const std::string& word) {
    if (word == "begins") return RowTime::span_begins;
    return word == "ends" ? RowTime::span_ends : RowTime::instant;
}

const std::vector<double>& hours_of(const WeatherTable& table, Q quantity) {
    return quantity == Q::global || quantity == Q::par ? table.light_hours : table.hours;
}

bool has_spans(const WeatherTable& table, Q quantity) {
    return quantity == Q::rain || ((quantity == Q::global || quantity == Q::par) && table.has_mean_light);
}

}  // namespace

std::optional<double> read_fill_hours(const Settings& settings) {
    const bool is_on = settings.choice_or("fill", "none", {"none", "linear"}) == "linear";
    if (!is_on && settings.has("fill_hours")) {
        throw UserError(settings.place("fill_hours"), "'fill_hours' needs fill = \"linear\"");
    }
    if (!is_on) return std::nullopt;
    return settings.number_or("fill_hours", 3, Range::between(0, 8784));
}

double read_days(const Settings& settings, const Weather* weather) {
    const double days = settings.number_or("days", weather ? weather->days() : 1, Range::positive());
    if (!weather || days == weather->days()) return days;
    throw UserError(settings.place("days"),
                    fmt::format("'days' is the weather's, {}: leave it out here", format_general(weather->days())));
}

Weather::Weather(const Settings& settings, std::vector<Diagnostic>* warnings) {
    days_ = settings.number_or("days", 1, Range::positive());
    read_numbers(settings);
    if (settings.has("file")) {
        read_file(settings, warnings);
    } else {
        read_place(settings);
        read_days(settings);
    }
    read_height(settings);
    take_defaults(settings, warnings);
    thermal_.base = settings.number_or("base", 0, Range::between(-20, 40));
    if (settings.has("optimum")) thermal_.optimum = settings.number("optimum", Range::between(-20, 60));
    if (settings.has("ceiling")) thermal_.ceiling = settings.number("ceiling", Range::between(-20, 80));
    if (settings.has("ceiling") && !settings.has("optimum")) {
        throw UserError(settings.place("ceiling"), "'ceiling' needs an 'optimum', from which on less warmth counts");
    }
    if (thermal_.optimum <= thermal_.base || (settings.has("ceiling") && thermal_.ceiling <= thermal_.optimum)) {
        throw UserError(settings.place("optimum"), "'base', 'optimum' and 'ceiling' must rise");
    }
    below_ = settings.number_or("twilight", 0.833, Range::between(0, 18));
}

void Weather::read_number(const Settings& settings, const char* key, Q quantity, Range range) {
    if (settings.has(key)) of(quantity) = settings.number(key, range);
}

void Weather::read_numbers(const Settings& settings) {
    read_number(settings, "temperature", Q::temperature, Range::between(-40, 60));
    read_number(settings, "wind", Q::wind, Range::between(0, 100));
    read_number(settings, "rain", Q::rain, Range::between(0, 1e5));
    if (of(Q::rain)) *of(Q::rain) /= 24;
    if (settings.has("humidity")) of(Q::humidity) = leaf::read_humidity(settings, 0);
    if (settings.has("co2")) of(Q::carbon_dioxide) = leaf::read_carbon_dioxide(settings, 0);
    read_number(settings, "pressure", Q::pressure, Range::between(20, 120));
}

void Weather::read_place(const Settings& settings) {
    place_.latitude = settings.number_or("latitude", place_.latitude, Range::between(-90, 90));
    place_.longitude = settings.number_or("longitude", place_.longitude, Range::between(-180, 180));
    place_.zone = settings.number_or("zone", place_.zone, Range::between(-14, 14));
    year_ =
        static_cast<double>(settings.integer_or("year", static_cast<std::int64_t>(year_), Range::between(1950, 2050)));
    day_ = settings.number_or("day", day_, Range::between(1, 366));
}

void Weather::read_file(const Settings& settings, std::vector<Diagnostic>* warnings) {
    WeatherReading reading;
    reading.fill_hours = read_fill_hours(settings);
    reading.warnings = warnings;
    if (settings.has("stamp")) {
        reading.time = row_time(settings.choice_or("stamp", "instant", {"instant", "begins", "ends"}));
    }
    reading.photons_of_par = settings.number_or("photons", 4.57, Range::positive());
    reading.photons_of_global = reading.photons_of_par * settings.number_or("par_share", 0.5, Range{0, 1, true});
    for (std::size_t q = 0; q < air_quantities; ++q) {
        if (constants_[q]) reading.given.insert(static_cast<Q>(q));
    }
    WeatherTable table = read_weather_file(settings.path("file"), reading);
    if (table.place) place_ = *table.place;
    if (table.height) height_ = *table.height;
    if (table.year > 0) {
        year_ = std::clamp(table.year, 1950, 2050);
        day_ = table.day;
    }
    read_place(settings);
    if (table.has(Q::highest)) table = course_of_days(table, place_, year_, table.day > 0 ? table.day : day_);
    begin_at_day(table);
    wind_factor_ =
        wind_factor(settings.number_or("wind_height", table.wind_height.value_or(2), Range::between(0.5, 200)));
    repeats_ = settings.flag_or("repeat", false);
    const double rain = settings.number_or("rain_factor", 1, Range::between(0, 1000));
    if (settings.has("rain_factor") && !table.has(Q::rain)) {
        throw UserError(settings.place("rain_factor"), "this file has no rain, of which there could be more or less");
    }
    for (double& amount : table.of(Q::rain)) amount *= rain;
    table_ = std::make_shared<WeatherTable>(std::move(table));
}

/// The run begins at the midnight of its day.
void Weather::begin_at_day(WeatherTable& table) const {
    if (table.day == 0) return;
    const double days = day_ - table.day, shift = 24 * (days < 0 ? days + 365 : days);
    for (auto* column : {&table.hours, &table.from, &table.to, &table.light_hours}) {
        for (double& hours : *column) hours -= shift;
    }
}

/// The same day all the time, but for the sun.
void Weather::read_days(const Settings& settings) {
    const bool has_highest = settings.has("highest"), has_lowest = settings.has("lowest");
    if (has_highest != has_lowest) {
        throw UserError(settings.place(has_highest ? "highest" : "lowest"),
                        "the course of a day needs both 'highest' and 'lowest'");
    }
    if (has_highest && of(Q::temperature)) {
        throw UserError(settings.place("temperature"),
                        "the temperature is given twice: leave out 'temperature', or 'highest' and 'lowest'");
    }
    if (!has_highest && !settings.has("radiation")) return;
    const double constant = of(Q::temperature).value_or(25);
    const Range range = Range::between(-40, 60);
    const double highest = has_highest ? settings.number("highest", range) : constant;
    const double lowest = has_highest ? settings.number("lowest", range) : constant;
    if (lowest > highest) throw UserError(settings.place("lowest"), "'lowest' is above 'highest'");
    WeatherTable year;
    year.source = settings.place("highest").file;
    for (int day = 0; day < 365; ++day) {
        year.hours.push_back(24.0 * day);
        year.lines.push_back(settings.place(has_highest ? "highest" : "radiation").line);
        year.of(Q::highest).push_back(highest);
        year.of(Q::lowest).push_back(lowest);
        if (of(Q::humidity)) year.of(Q::humidity).push_back(*of(Q::humidity));
        if (!settings.has("radiation")) continue;
        const double power = settings.number("radiation", Range::between(0, 50)) * 1e6 / 86400;
        year.of(Q::global).push_back(power);
        year.of(Q::par).push_back(power * 0.5 * 4.57);
        year.of(Q::diffuse).push_back(std::numeric_limits<double>::quiet_NaN());
    }
    // Its vapour pressure is that of the day, so that the humidity has a course.
    if (has_highest) of(Q::humidity).reset();
    table_ = std::make_shared<WeatherTable>(course_of_days(year, place_, year_, day_));
    repeats_ = true;
}

void Weather::read_height(const Settings& settings) {
    if (settings.has("height") && of(Q::pressure)) {
        throw UserError(settings.place("height"), "give either 'height' above the sea or 'pressure'");
    }
    height_ = settings.number_or("height", height_, Range::between(-500, 9000));
    if (!of(Q::pressure) && !(table_ && table_->has(Q::pressure))) {
        of(Q::pressure) = height_ == 0 ? leaf::sea_level : leaf::pressure_at_height(height_);
    }
}

void Weather::take_defaults(const Settings& settings, std::vector<Diagnostic>* warnings) {
    const auto take = [&](Q quantity, const char* key, double value, const char* words) {
        if (of(quantity) || (table_ && table_->has(quantity))) return;
        of(quantity) = value;
        if (!settings.has("file") || !warnings || !words) return;
        Diagnostic warning;
        warning.severity = Diagnostic::Severity::warning;
        warning.place = {table_->source, 0, 0};
        warning.message =
            fmt::format("this file has no '{}': it is {}; write {} = ... in the scene for another", key, words, key);
        warnings->push_back(std::move(warning));
    };
    take(Q::temperature, "temperature", 25, "25 degrees Celsius at all times");
    take(Q::humidity, "humidity", 0.6, "0.6 at all times");
    take(Q::wind, "wind", 1, "1 m/s at all times");
    take(Q::carbon_dioxide, "co2", 400, nullptr);
}

std::shared_ptr<const Weather> Weather::named_by(const Settings& settings, const char* key, const Fields& fields) {
    if (!settings.has(key)) return nullptr;
    const std::string name = settings.text(key);
    const auto* const weather = dynamic_cast<const Weather*>(fields.shared(name));
    if (weather) return {std::shared_ptr<const Weather>(), weather};  // lives as long as the fields
    throw UserError(settings.place(key), fmt::format("there is no weather called '{}' before this in the scene: write "
                                                     "[environment.{}] with process = \"weather\" above it",
                                                     name, name));
}

std::vector<ChangingSetting> Weather::changing_settings() {
    std::vector<ChangingSetting> all;
    const auto add = [&](const char* key, Q quantity, Range range) {
        if (of(quantity)) all.push_back(changing(key, range, *of(quantity)));
    };
    add("temperature", Q::temperature, Range::between(-40, 60));
    add("humidity", Q::humidity, Range::between(0, 1));
    add("wind", Q::wind, Range::between(0, 100));
    add("co2", Q::carbon_dioxide, Range::between(50, 10000));
    return all;
}

double Weather::period() const {
    return 24 * std::max(1.0, std::round((table_->last() - table_->first()) / 24));
}

void Weather::require_covered(double from, double to) const {
    if (!table_ || repeats_) return;
    const double row = table_->hours[1] - table_->hours[0];
    if (from >= table_->first() - row - 1e-6 && to <= table_->last() + row + 1e-6) return;
    throw RunError(
        fmt::format("{} has weather from day {} to {} of the run, and this step needs {} to {}: give more "
                    "rows or fewer steps, or let it begin anew with repeat = true",
                    table_->source, format_general(table_->first() / 24), format_general(table_->last() / 24),
                    format_general(from / 24), format_general(to / 24)));
}

void Weather::for_pieces(Q quantity, double from, double to, const Visit& visit) const {
    if (const std::optional<double>& constant = of(quantity)) return visit(*constant, *constant, to - from);
    if (!table_ || !table_->has(quantity)) return;
    if (!repeats_) return for_pieces_of_file(quantity, from, to, visit);
    const double length = period();
    for (double at = from; at < to;) {
        const double turns = std::floor((at - table_->first()) / length);
        const double end = std::min(to, table_->first() + (turns + 1) * length);
        for_pieces_of_file(quantity, at - turns * length, end - turns * length, visit);
        at = end > at ? end : to;
    }
}

void Weather::for_pieces_of_file(Q quantity, double from, double to, const Visit& visit) const {
    const WeatherTable& table = *table_;
    const std::vector<double>& values = table.of(quantity);
    if (has_spans(table, quantity)) {
        const auto first = std::upper_bound(table.to.begin(), table.to.end(), from);
        for (auto i = static_cast<std::size_t>(first - table.to.begin()); i < values.size(); ++i) {
            const double begin = std::max(from, table.from[i]), end = std::min(to, table.to[i]);
            if (begin >= to) break;
            if (end > begin) visit(values[i], values[i], end - begin);
        }
        return;
    }
    const std::vector<double>& hours = hours_of(table, quantity);
    if (from < hours.front()) visit(values.front(), values.front(), std::min(to, hours.front()) - from);
    const auto after = std::upper_bound(hours.begin(), hours.end(), from);
    auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - hours.begin()));
    for (; i < hours.size() && hours[i - 1] < to; ++i) {
        const double begin = std::max(from, hours[i - 1]), end = std::min(to, hours[i]);
        const auto at = [&](double hour) {
            const double t = (hour - hours[i - 1]) / (hours[i] - hours[i - 1]);
            return values[i - 1] + t * (values[i] - values[i - 1]);
        };
        if (end > begin) visit(at(begin), at(end), end - begin);
    }
    if (to > hours.back()) visit(values.back(), values.back(), to - std::max(from, hours.back()));
}

double Weather::integral(Q quantity, double from, double to) const {
    double sum = 0;
    for_pieces(quantity, from, to, [&](double begin, double end, double hours) { sum += (begin + end) / 2 * hours; });
    return sum;
}

double Weather::mean(Q quantity, double from, double to) const {
    return integral(quantity, from, to) / (to - from);
}

double Weather::wind_at_2_m(double from, double to) const {
    return mean(Q::wind, from, to) * (of(Q::wind) ? 1 : wind_factor_);
}

AirOfStep Weather::of_step(int step, double time, double dt) const {
    const double span = 24 * days_ * dt, to = step > 0 ? 24 * days_ * time : span, from = to - span;
    require_covered(from, to);
    const Extremes extreme = extremes(from, to);
    AirOfStep air;
    air.temperature = mean(Q::temperature, from, to);
    air.highest = extreme.highest;
    air.lowest = extreme.lowest;
    air.humidity = mean(Q::humidity, from, to);
    air.wind = wind_at_2_m(from, to);
    air.pressure = mean(Q::pressure, from, to);
    air.carbon_dioxide = mean(Q::carbon_dioxide, from, to);
    air.daylength = day_of_sun(place_, year_, std::floor(day_ + from / 24 + 1e-9), below_).length();
    if (!has_radiation()) air.evaporation = std::nan("");
    if (step == 0) return air;
    air.rain = integral(Q::rain, from, to);
    air.radiation = integral(Q::global, from, to) * 3600e-6;
    for_pieces(Q::temperature, from, to, [&](double begin, double end, double hours) {
        air.thermal += thermal_.mean_between(begin, end) * hours / 24;
    });
    if (has_radiation()) air.evaporation = evaporation_between(from, to);
    return air;
}

Weather::Extremes Weather::extremes(double from, double to) const {
    Extremes all;
    for_pieces(Q::temperature, from, to, [&](double begin, double end, double) {
        all.highest = std::max({all.highest, begin, end});
        all.lowest = std::min({all.lowest, begin, end});
    });
    return all;
}

double Weather::evaporation_between(double from, double to) const {
    double sum = 0;
    for (double at = from; at < to;) {
        const double midnight = 24 * std::floor(at / 24 + 1e-9), end = std::min(to, midnight + 24);
        const double all = integral(Q::global, midnight, midnight + 24);
        const double share = all > 0 ? integral(Q::global, at, end) / all : (end - at) / 24;
        sum += reference_of_day(midnight / 24) * share;
        at = end;
    }
    return sum;
}

double Weather::reference_of_day(double day) const {
    const double from = 24 * day, to = from + 24;
    const Extremes extreme = extremes(from, to);
    leaf::DayOfAir air;
    air.highest = extreme.highest;
    air.lowest = extreme.lowest;
    constexpr int samples = 48;
    air.vapour_pressure = 0;
    for (int k = 0; k < samples; ++k) {
        const double begin = from + 0.5 * k, end = begin + 0.5;
        air.vapour_pressure +=
            mean(Q::humidity, begin, end) * leaf::saturation_pressure(mean(Q::temperature, begin, end)) / samples;
    }
    air.wind = wind_at_2_m(from, to);
    air.radiation = integral(Q::global, from, to) * 3600e-6;
    air.latitude = place_.latitude;
    air.height = height_;
    air.day = (static_cast<int>(std::floor(day_ + day)) - 1) % 365 + 1;
    return std::max(0.0, leaf::reference_evaporation(air).evaporation);
}

double Weather::rain_rate(double day) const {
    const double at = 24 * day + 1e-6;
    require_covered(at, at);
    return 24 * mean(Q::rain, at, at + 1e-6);
}

double Weather::evaporation_rate(double day) const {
    const double hour = std::floor(24 * day + 1e-6);
    require_covered(hour, hour);
    return 24 * evaporation_between(hour, hour + 1);
}

double Weather::next_change(double day) const {
    const double hour = 24 * day + 1e-6;
    double next = std::floor(hour) + 1;
    if (table_ && table_->has(Q::rain)) {
        const double turns = repeats_ ? std::floor((hour - table_->first()) / period()) * period() : 0;
        const auto edge = std::upper_bound(table_->to.begin(), table_->to.end(), hour - turns);
        if (edge != table_->to.end()) next = std::min(next, *edge + turns);
        const auto begin = std::upper_bound(table_->from.begin(), table_->from.end(), hour - turns);
        if (begin != table_->from.end()) next = std::min(next, *begin + turns);
    }
    return next / 24;
}

const std::string& weather_help() {
    static const std::string text =
        R"(file           none; a table of weather, as below. Numbers of the scene replace columns of the file
temperature    25 degrees Celsius; or highest and lowest, of which half cosines make a day's course
highest        none, degrees Celsius; two hours after the sun's noon
lowest         none, degrees Celsius; at sunrise
humidity       0.6; relative humidity, 0 to 1; with highest and lowest at the day's mean temperature
wind           1 m/s; 2 m above the ground
co2            400 umol/mol; carbon dioxide in the air
rain           0 mm/d; falling evenly, where no file says it
rain_factor    1; by which the rain of the file is more or less
radiation      none, MJ m-2 d-1; light of all wavelengths on level ground in a day, without a file
pressure       101.325 kPa; or height, which gives it
height         0 m; above the sea
latitude       that of the file, or 50 degrees to the north
longitude      that of the file, or 0 degrees to the east
zone           that of the file, or 0; hours by which civil time is ahead of Greenwich
year           that of the file, or 2025; of the first day
day            that of the file, or 172; the day at whose midnight the run begins, counted from 1 on 1 January
days           1; days that a unit of the scene's time stands for
base           0 degrees Celsius; below it no warmth counts as thermal time
optimum        none, degrees Celsius; above it less counts, or, without ceiling, no more
ceiling        none, degrees Celsius; from there on nothing counts
twilight       0.833 degrees; how deep the sun stands below the horizon where the day begins and ends; 6: civil twilight
stamp          "instant", "begins", "ends"; of a CSV: its values are of the moment, or means of the span that the time begins
               or ends
wind_height    2 m (EPW, TMY3, PVGIS: 10); height at which the file's wind was measured; it counts as at 2 m (Allen et al.
               1998, eq. 47)
fill           "none", "linear"; what to do with missing values: none: they are mistakes; linear: they lie on a line between
               their neighbours
fill_hours     3 h; longer holes are mistakes with fill = "linear", too
repeat         false; true begins the file anew where it ends
par_share      0.5; share of PAR in the light's energy
photons        4.57 umol per joule of PAR (McCree 1972)
)";
    return text;
}

double ThermalTime::at(double temperature) const {
    if (temperature <= base || temperature >= ceiling) return 0;
    if (temperature <= optimum) return temperature - base;
    if (!std::isfinite(ceiling)) return optimum - base;
    return (optimum - base) * (ceiling - temperature) / (ceiling - optimum);
}

/// Of `at`, from the base.
double ThermalTime::integral_to(double temperature) const {
    const double rising = std::clamp(temperature, base, optimum) - base;
    double sum = rising * rising / 2;
    if (temperature <= optimum) return sum;
    const double most = optimum - base;
    if (!std::isfinite(ceiling)) return sum + most * (temperature - optimum);
    const double width = ceiling - optimum, left = std::max(0.0, ceiling - temperature) / width;
    sum += most * width / 2 * (1 - left * left);
    return sum;
}

double ThermalTime::mean_between(double begin, double end) const {
    if (std::abs(end - begin) < 1e-6) return at((begin + end) / 2);
    return (integral_to(end) - integral_to(begin)) / (end - begin);
}

}  // namespace espalier::environment
