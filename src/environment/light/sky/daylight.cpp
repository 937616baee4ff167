#include "environment/light/sky/daylight.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr double seconds_of_day = 86400;

std::vector<std::string> kinds_of_sky() {
    std::vector<std::string> kinds{"uniform", "overcast"};
    for (int type = 1; type <= 15; ++type) kinds.push_back("cie-" + std::to_string(type));
    return kinds;
}

glm::dvec3 unit_vector(const Settings& sky, const char* key, const glm::dvec3& fallback) {
    const glm::dvec3 given = sky.vector_or(key, fallback);
    if (!(glm::length(given) > 0)) {
        throw UserError(sky.place(key), std::string("'") + key + "' must not be the vector of zeros");
    }
    return glm::normalize(given);
}

double light_of(const Settings& sky, const char* key) {
    const double light = sky.number(key, Range::not_negative());
    if (light > 0) return light;
    throw UserError(sky.place(key), fmt::format("'{}' is 0: a sky without light lights nothing", key));
}

}  // namespace

DaylightSeries::DaylightSeries(const Settings& sky, double lowest_rise, std::vector<Diagnostic>* warnings)
    : DaylightSeries(sky, lowest_rise, nullptr, warnings) {}

DaylightSeries::DaylightSeries(const Settings& sky, double lowest_rise, const std::shared_ptr<const Weather>& weather,
                               std::vector<Diagnostic>* warnings)
    : least_rise_(lowest_rise) {
    read_sky(sky);
    north_ = unit_vector(sky, "north", {0, 0, -1});
    if (north_.y != 0) throw UserError(sky.place("north"), "'north' must be horizontal: [x, 0, z]");
    if (sky.has("diffuse")) diffuse_ = sky.number("diffuse", Range::between(0, 1));
    if (weather) {
        read_weather(sky, *weather);
        return;
    }
    photons_.of_par = sky.number_or("photons", 4.57, Range::positive());
    photons_.of_global = photons_.of_par * sky.number_or("par_share", 0.5, Range{0, 1, true});
    if (sky.has("par") || sky.has("global")) {
        read_steady(sky);
    } else if (sky.has("series")) {
        read_path(sky, warnings);
        read_series(sky);
    } else {
        read_path(sky, warnings);
        clearness_ = sky.has("clearness") ? light_of(sky, "clearness") : sky.number_or("clearness", 0.5);
        if (clearness_ > 1) throw UserError(sky.place("clearness"), "'clearness' must lie between 0 and 1");
        read_hours(sky);
    }
}

void DaylightSeries::read_sky(const Settings& sky) {
    kind_ = sky.choice_or("radiance", "overcast", kinds_of_sky());
    parts_ = sky_parts(sky.integer_or("rings", 5, Range::between(1, 64)),
                       sky.integer_or("around", 8, Range::between(3, 720)), kind_ == "overcast" ? 2 : 0);
    std::erase_if(parts_, [&](const SkyPart& part) { return part.towards.y < least_rise_; });
    for (SkyPart& part : parts_) part.window.lowest = std::max(part.window.lowest, least_rise_);
}

void DaylightSeries::read_steady(const Settings& sky) {
    if (sky.has("par") && sky.has("global")) {
        throw UserError(sky.place("global"), "the light is given twice, as 'par' and as 'global': leave one out");
    }
    steady_ = sky.has("par") ? light_of(sky, "par") : photons_.of_global * light_of(sky, "global");
    if (sky.has("suns")) return read_suns(sky);
    suns_ = {{unit_vector(sky, "sun", {0, 1, 0}), 1}};
    if (suns_[0].towards.y < least_rise_ && diffuse_.value_or(1) < 1) {
        throw UserError(sky.place("sun"), "the sun must stand at least 2 degrees above the horizon");
    }
}

void DaylightSeries::read_suns(const Settings& sky) {
    if (sky.has("sun")) {
        throw UserError(sky.place("sun"), "the direction is given twice, as 'sun' and as 'suns': leave one out");
    }
    const std::vector<glm::dvec3> directions = sky.vectors("suns");
    const std::vector<double> shares = sky.numbers_or("sun_shares", std::vector<double>(directions.size(), 1));
    double sum = 0;
    for (const double share : shares) sum += share >= 0 ? share : std::nan("");
    if (shares.size() != directions.size() || !(sum > 0) || !std::isfinite(sum)) {
        throw UserError(sky.place(sky.has("sun_shares") ? "sun_shares" : "suns"),
                        fmt::format("'sun_shares' must have a number from 0 on for each of the {} 'suns', not all 0",
                                    directions.size()));
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double length = glm::length(directions[i]);
        if (!(directions[i].y >= least_rise_ * length && length > 0)) {
            throw UserError(sky.place("suns"),
                            fmt::format("sun {} must stand at least 2 degrees above the horizon", i + 1));
        }
        suns_.push_back({directions[i] / length, shares[i] / sum});
    }
}

void DaylightSeries::read_path(const Settings& sky, std::vector<Diagnostic>* warnings) {
    place_.latitude = sky.number_or("latitude", 50, Range::between(-90, 90));
    place_.longitude = sky.number_or("longitude", 0, Range::between(-180, 180));
    place_.zone = sky.number_or("zone", 0, Range::between(-14, 14));
    if (sky.has("series")) {
        WeatherReading reading;
        reading.light_only = true;
        reading.fill_hours = read_fill_hours(sky);
        reading.photons_of_par = photons_.of_par;
        reading.photons_of_global = photons_.of_global;
        reading.warnings = warnings;
        series_.emplace(std::make_shared<const WeatherTable>(read_weather_file(sky.path("series"), reading)));
    }
    const bool is_dated = series_ && series_->year() > 0;
    year_ = static_cast<double>(sky.integer_or("year", is_dated ? series_->year() : 2025, Range::between(1950, 2050)));
    day_ = sky.number_or("day", is_dated ? series_->day() : 172, Range::between(1, 366));
}

void DaylightSeries::read_hours(const Settings& sky) {
    adaptive_ = sky.choice_or("integration", "hours", {"hours", "adaptive"}) == "adaptive";
    if (adaptive_ && sky.has("hours")) {
        throw UserError(sky.place("hours"), "with integration = \"adaptive\" the hours are chosen: leave 'hours' out");
    }
    if (adaptive_) return;
    std::vector<double> each;
    for (int hour = 0; hour < 24; ++hour) each.push_back(hour + 0.5);
    const std::vector<double> hours = sky.numbers_or("hours", each);
    if (hours.empty()) throw UserError(sky.place("hours"), "'hours' must name at least one hour of the day");
    for (std::size_t i = 0; i < hours.size(); ++i) {
        if (!(hours[i] >= 0 && hours[i] < 24 && (i == 0 || hours[i] > hours[i - 1]))) {
            throw UserError(sky.place("hours"), "'hours' must rise, and lie from 0 to before 24");
        }
        // Each stands for the time to the middles between it and its neighbours, around the clock.
        const double before = i > 0 ? hours[i - 1] : hours.back() - 24;
        const double after = i + 1 < hours.size() ? hours[i + 1] : hours.front() + 24;
        hours_.push_back({hours[i], (after - before) / 2});
    }
}

/// Place, date and light are the weather's.
void DaylightSeries::read_weather(const Settings& sky, const Weather& weather) {
    for (const char* key : {"par", "global", "series", "latitude", "longitude", "zone", "year", "day", "repeat",
                            "clearness", "hours", "integration", "par_share", "photons", "fill"}) {
        if (!sky.has(key)) continue;
        throw UserError(sky.place(key), fmt::format("'{}' is the weather's: leave it out here, or 'weather'", key));
    }
    if (!weather.has_radiation()) {
        throw UserError(sky.place("weather"),
                        fmt::format("the weather '{}' has no light: give it 'radiation' (MJ m-2 d-1), a file with a "
                                    "column 'global (W m-2)', or the sky light of its own, as 'clearness'",
                                    sky.text("weather")));
    }
    place_ = weather.place();
    year_ = weather.year();
    day_ = weather.day();
    repeats_ = weather.repeats();
    sample_ = sky.number_or("sample", 0.5, Range::between(0.01, 24));
    series_.emplace(weather.table());
    require_light_by_day();
}

void DaylightSeries::read_series(const Settings& sky) {
    repeats_ = sky.flag_or("repeat", false);
    sample_ = sky.number_or("sample", 0.5, Range::between(0.01, 24));
    require_light_by_day();
}

void DaylightSeries::require_light_by_day() const {
    for (const MeasuredLight& row : series_->rows()) {
        const SunPosition sun = sun_position(
            place_, {year_, day_ + std::floor(row.hours / 24), row.hours - 24 * std::floor(row.hours / 24)});
        const double below = -sun.elevation * 180 / std::numbers::pi;
        if (below < 3 || row.global < 50) continue;
        throw UserError(
            {series_->source(), row.line, 0},
            fmt::format("{:.4g} W m-2 are measured while the sun stands {:.0f} degrees below the horizon: check "
                        "latitude, longitude and zone, and that times are civil time of the place",
                        row.global, below));
    }
}

SkyRadiance DaylightSeries::radiance(const glm::dvec3& sun) const {
    if (kind_ == "uniform") return SkyRadiance::uniform();
    if (kind_ == "overcast") return SkyRadiance::overcast();
    return SkyRadiance::cie(std::stoi(kind_.substr(4)), sun);
}

Daylight DaylightSeries::over(double elapsed, double days) const {
    Sums sums;
    for (const SkyPart& part : parts_) sums.light.beams.push_back({part.towards, 0, false, part.window});
    if (steady_) {
        add_steady(days, sums);
    } else if (series_) {
        add_series(elapsed, days, sums);
    } else {
        add_days(elapsed, days, sums);
    }
    for (const auto& [slot, sun] : sums.suns) {
        const glm::dvec3 towards = glm::normalize(sun.direction);
        sums.light.beams.push_back({towards, sun.on_ground / towards.y, true});
    }
    return sums.light;
}

void DaylightSeries::add(const Moment& moment, Sums& sums) const {
    if (moment.par <= 0) return;
    const bool is_up = moment.sun.y >= least_rise_;
    const double photons = 1e-6 * moment.par * moment.seconds, diffuse = is_up ? moment.diffuse_share : 1;
    const std::vector<double> shares = shares_on_ground(radiance(moment.sun), parts_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        sums.light.beams[i].photons += photons * diffuse * shares[i] / parts_[i].towards.y;
    }
    if (diffuse < 1) {
        SunSum& sun = sums.suns[moment.slot];
        sun.on_ground += photons * (1 - diffuse);
        sun.direction += photons * (1 - diffuse) * moment.sun;
    }
    sums.light.on_ground += photons;
    sums.light.energy += moment.global * moment.seconds;
    sums.light.seconds += moment.seconds;
}

void DaylightSeries::add_steady(double days, Sums& sums) const {
    const double seconds = seconds_of_day * days;
    int slot = 0;
    for (const auto& [towards, share] : suns_) {
        const double par = share * *steady_;
        add({towards, seconds, par, par / photons_.of_global, diffuse_.value_or(1), slot++}, sums);
    }
    sums.light.seconds = seconds;
}

void DaylightSeries::add_days(double elapsed, double days, Sums& sums) const {
    const double day = std::floor(day_ + elapsed + days / 2);
    int slot = 0;
    for (const Hour& hour : hours_of(day)) add(at_hour(day, {hour.at, hour.span * days}, slot++), sums);
}

DaylightSeries::Moment DaylightSeries::at_hour(double day, const Hour& hour, int slot) const {
    const SunPosition position = sun_position(place_, {year_, day, hour.at});
    const glm::dvec3 sun = towards_sun(position, north_);
    const double global = sun.y < least_rise_ ? 0 : clearness_ * extraterrestrial_flux(position) * sun.y;
    return {sun, 3600 * hour.span, photons_.of_global * global, global, diffuse_.value_or(diffuse_share(clearness_)),
            slot};
}

/// The hours of the scene, or so many between the sun's rise and set that twice as many change little.
std::vector<DaylightSeries::Hour> DaylightSeries::hours_of(double day) const {
    if (!adaptive_) return hours_;
    const auto rise_at = [&](double hour) {
        return towards_sun(sun_position(place_, {year_, day, hour}), north_).y - least_rise_;
    };
    std::vector<Hour> all;
    constexpr double step = 0.1;
    double begin = rise_at(0) > 0 ? 0 : -1;
    for (int i = 1; i <= 240; ++i) {
        const double before = step * (i - 1), now = step * i;
        const bool was_up = rise_at(before) > 0, is_up = rise_at(now) > 0;
        double low = before, high = now;
        for (int turn = 0; turn < 40 && was_up != is_up; ++turn) {
            const double middle = (low + high) / 2;
            ((rise_at(middle) > 0) == is_up ? high : low) = middle;
        }
        if (!was_up && is_up) begin = high;
        if (begin >= 0 && ((was_up && !is_up) || (is_up && i == 240))) {
            for (const Hour& hour : hours_between(begin, is_up ? 24 : low, day)) all.push_back(hour);
            begin = -1;
        }
    }
    return all;
}

std::vector<DaylightSeries::Hour> DaylightSeries::hours_between(double rise, double set, double day) const {
    constexpr double tolerance = 1e-3;
    double before = -1;
    for (std::int64_t count = 4;; count *= 2) {
        std::vector<Hour> hours;
        double light = 0;
        for (const GaussPoint& point : gauss_points(count)) {
            hours.push_back({rise + (set - rise) * point.at, (set - rise) * point.weight});
            const Moment moment = at_hour(day, hours.back(), 0);
            light += moment.global * moment.seconds;
        }
        std::sort(hours.begin(), hours.end(), [](const Hour& a, const Hour& b) { return a.at < b.at; });
        if (count >= 64 || std::abs(light - before) <= tolerance * light) return hours;
        before = light;
    }
}

/// From hours since the run's first midnight to those of the series.
double DaylightSeries::series_hours(double hours) const {
    if (!repeats_) return hours;
    const double period = 24 * std::max(1.0, std::round((series_->last() - series_->first()) / 24));
    return series_->first() + std::fmod(std::fmod(hours - series_->first(), period) + period, period);
}

void DaylightSeries::add_series(double elapsed, double days, Sums& sums) const {
    const double from = 24 * elapsed, to = 24 * (elapsed + days);
    const double row = series_->rows()[1].hours - series_->rows()[0].hours;
    if (!repeats_ && (from < series_->first() - row || to > series_->last() + row)) {
        throw RunError(
            fmt::format("{} has light from {:g} to {:g} hours, and this step needs {:g} to {:g}: measure longer, "
                        "or let it begin anew with sky.repeat = true",
                        series_->source(), series_->first(), series_->last(), from, to));
    }
    std::vector<double> breaks{from, to};
    for (double at = std::ceil(from / sample_) * sample_; at < to; at += sample_) breaks.push_back(at);
    if (!repeats_) {
        const std::span<const double> all = series_->breaks();
        breaks.insert(breaks.end(), std::upper_bound(all.begin(), all.end(), from),
                      std::lower_bound(all.begin(), all.end(), to));
    }
    std::sort(breaks.begin(), breaks.end());
    // Light changes evenly in between, so the middle is the mean.
    for (std::size_t i = 1; i < breaks.size(); ++i) {
        const double span = breaks[i] - breaks[i - 1];
        if (span > 1e-9) add(measured(series_hours(breaks[i - 1] + span / 2), 3600 * span), sums);
    }
}

DaylightSeries::Moment DaylightSeries::measured(double hours, double seconds) const {
    const MeasuredLight row = series_->at(hours);
    const double hour = hours - 24 * std::floor(hours / 24);
    const SunPosition position = sun_position(place_, {year_, day_ + std::floor(hours / 24), hour});
    const glm::dvec3 sun = towards_sun(position, north_);
    double diffuse = diffuse_.value_or(1);
    if (row.diffuse >= 0 && row.global > 0) {
        diffuse = row.diffuse / row.global;
    } else if (!diffuse_ && sun.y >= least_rise_) {
        diffuse = diffuse_share(std::clamp(row.global / (extraterrestrial_flux(position) * sun.y), 0.0, 1.0));
    }
    return {sun, seconds, row.par, row.global, diffuse, static_cast<int>(hour / sample_)};
}

const std::string& sky_help() {
    static const std::string text =
        R"help(The table `sky` says what light there is. PAR are the photosynthetically active photons, 400 to 700 nm.
radiance      "overcast" (1 + 2 cos zenith angle; Moon & Spencer 1942), "uniform", or "cie-1" to "cie-15": the skies of
              ISO 15469:2004, of which cie-12 is the clear one
rings         5: rings of the sky. Of light from below 2 degrees above the horizon nothing is counted
around        8: parts of each ring; so 40 directions
north         [0, 0, -1]: horizontal direction to the north
diffuse       the share of the light on level ground that comes from the sky; the rest comes from the sun
par_share     0.5: share of PAR in the light's energy
photons       4.57 umol per joule of PAR (McCree 1972)

With par or global, the light is the same at all times:
par           PAR on open level ground, umol m-2 s-1; or
global        light of all wavelengths there, W m-2
sun           [0, 1, 0]: direction to the sun
suns          none; several directions instead, [[x, y, z], ...]
sun_shares    none; what each of the suns brings of the direct light on level ground, in proportion to these numbers, as in
              [3, 1]; none: equal shares
diffuse       1; share of the light that comes from the sky

Without them, the sun goes its way (Michalsky 1988), and a share of the light above the air reaches the ground:
latitude      50 degrees to the north
longitude     0 degrees to the east
zone          0: hours by which civil time is ahead of Greenwich
year          2025: of the first day
day           172: the first day, counted from 1 on 1 January
hours         [0.5, 1.5, ... 23.5]: hours of civil time at which the sun is looked at; each stands for the time
              to the middles between it and its neighbours. Of a step of several days, the middle day stands for all
integration   "hours", or "adaptive": as many times between the sun's rise and set as the day's light needs (0.1 %)
clearness     0.5: light on level ground over that above the air (1361 W/m2 across it)
diffuse       after Erbs et al. 1982, from the clearness

With series, the light is what was measured, and the sun goes its way:
series        a CSV file. Its header names columns and units: "time (h)" since the midnight at which the run begins,
              or "date" as 2025-06-21 13:30 in civil time; "global (W m-2)", "par (umol m-2 s-1)" or both, on level
              ground; "diffuse" or "direct" in one of these units, or "diffuse share (1)", if measured, else after Erbs
              et al. 1982. Commas, semicolons or tabs separate its cells. Values from -20 to 0 are 0; cells that are
              empty, NA, 9999 and the like were not measured, and other columns stand for them. Light changes evenly
              from row to row, and each step gets the integral over its time
fill          "none", or "linear", and fill_hours (3): as the process weather has them
sample        0.5 hours: how often the sun is looked at
repeat        false; true begins the series anew where it ends

With weather, the light, the place and the time are those of a process weather:
weather       the name of one that stands before this in the scene, and knows radiation. sample and diffuse as above
)help";
    return text;
}

}  // namespace espalier::environment
