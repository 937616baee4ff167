#include "environment/given/weather/course_of_day.h"

#include "espalier/base/math.h"

#include "environment/given/weather/day_of_sun.h"
#include "environment/leaf/gas/air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

constexpr int parts_of_day = 96;
constexpr double part = 24.0 / parts_of_day;  // hours
constexpr double highest_after_noon = 2;      // hours

/// Lowest and highest temperatures, one after the other, and between them half cosines.
struct Extreme {
    double hour, temperature;
};

double between(const Extreme& a, const Extreme& b, double hour) {
    const double t = std::clamp((hour - a.hour) / (b.hour - a.hour), 0.0, 1.0);
    return a.temperature + (b.temperature - a.temperature) * (1 - math::cos(std::numbers::pi * t)) / 2;
}

std::vector<Extreme> extremes_of(const WeatherTable& days, const std::vector<DayOfSun>& suns) {
    const std::vector<double>&lowest = days.of(AirQuantity::lowest), &highest = days.of(AirQuantity::highest);
    std::vector<Extreme> all;
    // Before the first sunrise it cools from its own day's highest, behind the last day to its lowest.
    all.push_back({days.hours[0] - 24 + suns[0].noon + highest_after_noon, highest[0]});
    for (std::size_t i = 0; i < days.size(); ++i) {
        // Where the sun does not rise, or not set, it is coldest half a day before noon, but not before midnight.
        const bool has_rise = suns[i].length() > 0 && suns[i].length() < 24;
        const double rise = has_rise ? suns[i].rise : suns[i].noon - 8;
        all.push_back({days.hours[i] + rise, lowest[i]});
        all.push_back({days.hours[i] + suns[i].noon + highest_after_noon, highest[i]});
    }
    all.push_back({days.hours.back() + 24 + suns.back().rise, lowest.back()});
    return all;
}

/// W m-2 for each part of a day, whose mean is `mean`.
std::vector<double> radiation_of(double mean, const GroundPlace& place, double year, double day) {
    std::vector<double> all;
    double sum = 0;
    for (int k = 0; k < parts_of_day; ++k) {
        const SunPosition sun = sun_position(place, {year, day, (k + 0.5) * part});
        all.push_back(std::max(0.0, math::sin(sun.elevation)));
        sum += all.back();
    }
    for (double& one : all) one = sum > 0 ? one * mean * parts_of_day / sum : 0;
    return sum > 0 || mean <= 0 ? all : std::vector<double>();
}

/// kPa, of a day.
double vapour_of(const WeatherTable& days, std::size_t i) {
    const double lowest = days.of(AirQuantity::lowest)[i], highest = days.of(AirQuantity::highest)[i];
    if (!days.has(AirQuantity::humidity)) return leaf::saturation_pressure(lowest);
    return days.of(AirQuantity::humidity)[i] * leaf::saturation_pressure((lowest + highest) / 2);
}

}  // namespace

WeatherTable course_of_days(const WeatherTable& days, const GroundPlace& place, double year, double day) {
    using Q = AirQuantity;
    std::vector<DayOfSun> suns;
    for (std::size_t i = 0; i < days.size(); ++i) {
        if (std::abs(days.hours[i] - days.hours[0] - 24.0 * static_cast<double>(i)) > 0.01) {
            throw UserError({days.source, days.lines[i], 0},
                            "a file with 'highest' and 'lowest' has a row for each day, all at one hour");
        }
        if (days.of(Q::lowest)[i] > days.of(Q::highest)[i]) {
            throw UserError({days.source, days.lines[i], 0},
                            fmt::format("the lowest temperature, {:g}, is above the highest, {:g}",
                                        days.of(Q::lowest)[i], days.of(Q::highest)[i]));
        }
        suns.push_back(day_of_sun(place, year, day + std::floor(days.hours[i] / 24)));
    }
    const std::vector<Extreme> extremes = extremes_of(days, suns);
    WeatherTable table;
    table.source = days.source;
    table.year = days.year;
    table.day = days.day;
    table.place = days.place;
    table.height = days.height;
    table.wind_height = days.wind_height;
    table.has_mean_light = true;
    std::size_t next = 1;
    for (std::size_t i = 0; i < days.size(); ++i) {
        const double midnight = 24 * std::floor(days.hours[i] / 24), vapour = vapour_of(days, i);
        std::vector<double> light;
        if (days.has(Q::global)) {
            light = radiation_of(days.of(Q::global)[i], place, year, day + midnight / 24);
            if (light.empty()) {
                throw UserError({days.source, days.lines[i], 0},
                                "this day has radiation, but the sun does not rise: check latitude and day");
            }
        }
        for (int k = 0; k < parts_of_day; ++k) {
            const double hour = midnight + k * part;
            while (next + 1 < extremes.size() && extremes[next].hour <= hour) ++next;
            const double temperature = between(extremes[next - 1], extremes[next], hour);
            table.hours.push_back(hour);
            table.light_hours.push_back(hour);
            table.from.push_back(hour);
            table.to.push_back(hour + part);
            table.lines.push_back(days.lines[i]);
            table.of(Q::temperature).push_back(temperature);
            table.of(Q::humidity).push_back(std::min(1.0, vapour / leaf::saturation_pressure(temperature)));
            for (const Q quantity : {Q::wind, Q::pressure, Q::rain, Q::carbon_dioxide}) {
                if (days.has(quantity)) table.of(quantity).push_back(days.of(quantity)[i]);
            }
            if (light.empty()) continue;
            const double share = days.of(Q::global)[i] > 0 ? light[k] / days.of(Q::global)[i] : 0;
            table.of(Q::global).push_back(light[k]);
            table.of(Q::par).push_back(share * days.of(Q::par)[i]);
            table.of(Q::diffuse).push_back(light[k] > 0 ? share * days.of(Q::diffuse)[i] : 0);
        }
    }
    return table;
}

}  // namespace espalier::environment
