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
    // Before the first sunrise it cools from its own day's highest, after the last day to its lowest.
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

void require_day(const WeatherTable& days, std::size_t i) {
    const double lowest = days.of(AirQuantity::lowest)[i], highest = days.of(AirQuantity::highest)[i];
    const Place place{days.source, days.lines[i], 0};
    if (std::abs(days.hours[i] - days.hours[0] - 24.0 * static_cast<double>(i)) > 0.01) {
        throw UserError(place, "a file with 'highest' and 'lowest' has a row for each day, all at one hour");
    }
    if (lowest <= highest) return;
    throw UserError(place, fmt::format("the lowest temperature, {:g}, is above the highest, {:g}", lowest, highest));
}

/// The rows of days, one after the other.
class CourseOfDays {
public:
    CourseOfDays(const WeatherTable& days, std::vector<Extreme> extremes)
        : days_(days), extremes_(std::move(extremes)) {
        table_ = days;
        for (auto* column : {&table_.hours, &table_.from, &table_.to, &table_.light_hours}) column->clear();
        for (std::vector<double>& column : table_.values) column.clear();
        table_.lines.clear();
        table_.has_mean_light = true;
    }

    void add(std::size_t i, const GroundPlace& place, double year, double first_day) {
        const double midnight = 24 * std::floor(days_.hours[i] / 24);
        for (int k = 0; k < parts_of_day; ++k) add_air(i, midnight + k * part);
        if (!days_.has(AirQuantity::global)) return;
        const std::vector<double> light =
            radiation_of(days_.of(AirQuantity::global)[i], place, year, first_day + midnight / 24);
        if (light.empty()) {
            throw UserError({days_.source, days_.lines[i], 0},
                            "this day has radiation, but the sun does not rise: check latitude and day");
        }
        for (const double power : light) add_light(i, power);
    }

    WeatherTable take() { return std::move(table_); }

private:
    using Q = AirQuantity;

    void add_air(std::size_t i, double hour) {
        while (next_ + 1 < extremes_.size() && extremes_[next_].hour <= hour) ++next_;
        const double temperature = between(extremes_[next_ - 1], extremes_[next_], hour);
        table_.hours.push_back(hour);
        table_.light_hours.push_back(hour);
        table_.from.push_back(hour);
        table_.to.push_back(hour + part);
        table_.lines.push_back(days_.lines[i]);
        table_.of(Q::temperature).push_back(temperature);
        const double most = leaf::saturation_pressure(temperature);
        table_.of(Q::humidity).push_back(std::min(1.0, vapour_of(days_, i) / most));
        for (const Q quantity : {Q::wind, Q::pressure, Q::rain, Q::carbon_dioxide}) {
            if (days_.has(quantity)) table_.of(quantity).push_back(days_.of(quantity)[i]);
        }
    }

    void add_light(std::size_t i, double power) {
        const double share = days_.of(Q::global)[i] > 0 ? power / days_.of(Q::global)[i] : 0;
        table_.of(Q::global).push_back(power);
        table_.of(Q::par).push_back(share * days_.of(Q::par)[i]);
        table_.of(Q::diffuse).push_back(power > 0 ? share * days_.of(Q::diffuse)[i] : 0);
    }

    const WeatherTable& days_;
    std::vector<Extreme> extremes_;
    std::size_t next_ = 1;
    WeatherTable table_;
};

}  // namespace

WeatherTable course_of_days(const WeatherTable& days, const GroundPlace& place, double year, double day) {
    std::vector<DayOfSun> suns;
    for (std::size_t i = 0; i < days.size(); ++i) {
        require_day(days, i);
        suns.push_back(day_of_sun(place, year, day + std::floor(days.hours[i] / 24)));
    }
    CourseOfDays course(days, extremes_of(days, suns));
    for (std::size_t i = 0; i < days.size(); ++i) course.add(i, place, year, day);
    return course.take();
}

}  // namespace espalier::environment
