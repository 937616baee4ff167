#include "environment/light/sun/sun.h"

#include "espalier/base/math.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

/// Days since noon of 1 January 2000 in Greenwich.
double days_since_2000(const CivilTime& time, double hour_in_greenwich) {
    const double year = time.year - 1949, leap_days = std::floor(year / 4);
    return 32916.5 + 365 * year + leap_days + time.day + hour_in_greenwich / 24 - 51545;
}

}  // namespace

SunPosition sun_position(const GroundPlace& place, const CivilTime& time) {
    const double hour = time.hour - place.zone, days = days_since_2000(time, hour);
    const double mean_longitude = 280.460 + 0.9856474 * days;
    const double anomaly = glm::radians(std::fmod(357.528 + 0.9856003 * days, 360));
    const double longitude =
        glm::radians(std::fmod(mean_longitude + 1.915 * math::sin(anomaly) + 0.020 * math::sin(2 * anomaly), 360));
    const double obliquity = glm::radians(23.439 - 0.0000004 * days);
    const double ascension = math::atan2(math::cos(obliquity) * math::sin(longitude), math::cos(longitude));
    const double declination = math::asin(math::sin(obliquity) * math::sin(longitude));

    const double sidereal_hours = 6.697375 + 0.0657098242 * days + hour + place.longitude / 15;
    const double hour_angle = glm::radians(std::fmod(15 * sidereal_hours, 360)) - ascension;
    const double latitude = glm::radians(place.latitude);
    const double up = math::sin(declination) * math::sin(latitude) +
                      math::cos(declination) * math::cos(latitude) * math::cos(hour_angle);
    const double north = math::sin(declination) * math::cos(latitude) -
                         math::cos(declination) * math::sin(latitude) * math::cos(hour_angle);
    const double east = -math::cos(declination) * math::sin(hour_angle);
    const double distance = 1.00014 - 0.01671 * math::cos(anomaly) - 0.00014 * math::cos(2 * anomaly);
    return {math::asin(std::clamp(up, -1.0, 1.0)), math::atan2(east, north), distance};
}

glm::dvec3 towards_sun(const SunPosition& position, const glm::dvec3& north) {
    const glm::dvec3 up(0, 1, 0), east = glm::cross(north, up);
    const auto [northward, eastward] = std::pair(math::cos(position.azimuth), math::sin(position.azimuth));
    return math::sin(position.elevation) * up + math::cos(position.elevation) * (northward * north + eastward * east);
}

std::vector<glm::dvec3> sun_path(double latitude, std::span<const double> days, std::int64_t samples,
                                 const glm::dvec3& north) {
    const GroundPlace place{latitude, 0, 0};
    std::vector<glm::dvec3> directions;
    for (const double day : days) {
        const auto is_up = [&](double hour) { return sun_position(place, {2025, day, hour}).elevation > 0; };
        // The sun passes the horizon between the dark hour and the light one.
        const auto horizon = [&](double dark, double light) {
            if (is_up(dark)) return dark;
            for (int turn = 0; turn < 50; ++turn) (is_up((dark + light) / 2) ? light : dark) = (dark + light) / 2;
            return light;
        };
        if (!is_up(12)) continue;
        const double rise = horizon(0, 12), set = horizon(24, 12);
        for (std::int64_t i = 0; i < samples; ++i) {
            const double hour = rise + (set - rise) * (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
            directions.push_back(towards_sun(sun_position(place, {2025, day, hour}), north));
        }
    }
    return directions;
}

double extraterrestrial_flux(const SunPosition& position) {
    return 1361 / (position.distance * position.distance);
}

double diffuse_share(double clearness) {
    if (clearness <= 0.22) return 1 - 0.09 * clearness;
    if (clearness > 0.80) return 0.165;
    const double k = clearness;
    return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

}  // namespace espalier::environment
