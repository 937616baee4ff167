#include "environment/leaf/gas/reference_evaporation.h"

#include "espalier/base/math.h"

#include "environment/leaf/gas/air.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment::leaf {
namespace {

constexpr double pi = std::numbers::pi;

struct SkyOfDay {
    double radiation;  ///< above the air, MJ m-2 d-1 (eq. 21)
    double hours;      ///< of daylight (eq. 34)
};

SkyOfDay sky_of(double latitude, int day) {
    constexpr double solar_constant = 0.0820;  // MJ m-2 min-1
    const double turn = 2 * pi * day / 365, phi = latitude * pi / 180;
    const double nearness = 1 + 0.033 * math::cos(turn);
    const double declination = 0.409 * math::sin(turn - 1.39);
    const double sunset = math::acos(std::clamp(-math::tan(phi) * math::tan(declination), -1.0, 1.0));
    const double height =
        sunset * math::sin(phi) * math::sin(declination) + math::cos(phi) * math::cos(declination) * math::sin(sunset);
    return {24 * 60 / pi * solar_constant * nearness * height, 24 / pi * sunset};
}

/// Net long-wave radiation that a lawn loses, MJ m-2 d-1 (eq. 39).
double long_wave(const DayOfAir& day, double share_of_clear) {
    const auto sent = [](double temperature) { return black_body(temperature) * 86400e-6; };
    return (sent(day.highest) + sent(day.lowest)) / 2 * (0.34 - 0.14 * std::sqrt(day.vapour_pressure)) *
           (1.35 * share_of_clear - 0.35);
}

}  // namespace

ReferenceEvaporation reference_evaporation(const DayOfAir& day) {
    const SkyOfDay sky = sky_of(day.latitude, day.day);
    const double by_sunshine = (0.25 + (sky.hours > 0 ? 0.5 * day.sunshine / sky.hours : 0)) * sky.radiation;  // eq. 35
    const double sun = day.radiation.value_or(by_sunshine);
    const double clear = (0.75 + 2e-5 * day.height) * sky.radiation;  // eq. 37
    const double share = clear > 0 ? std::min(1.0, sun / clear) : 0;
    const double net = (1 - 0.23) * sun - long_wave(day, share);
    const double mean = (day.highest + day.lowest) / 2, slope = saturation_slope(mean);
    const double gamma = 0.665e-3 * pressure_at_height(day.height);
    const double deficit =
        (saturation_pressure(day.highest) + saturation_pressure(day.lowest)) / 2 - day.vapour_pressure;
    const double evaporation = (0.408 * slope * net + gamma * 900 / (mean + 273) * day.wind * deficit) /
                               (slope + gamma * (1 + 0.34 * day.wind));  // eq. 6
    return {net, evaporation};
}

}  // namespace espalier::environment::leaf
