#include "environment/light/sun/sun.h"

#include "catch.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// The sun's ecliptic longitude and distance from an ellipse whose elements are those of Meeus 1998, Astronomical
/// Algorithms, chapter 25, by Kepler's equation; then turned into the horizon of a place. Degrees.
struct Reference {
    double elevation, azimuth, distance;
};

Reference kepler(const GroundPlace& place, double julian_day) {
    const double t = (julian_day - 2451545) / 36525;
    const double mean_longitude = 280.46646 + 36000.76983 * t + 0.0003032 * t * t;
    const double anomaly = glm::radians(357.52911 + 35999.05029 * t - 0.0001537 * t * t);
    const double e = 0.016708634 - 0.000042037 * t;
    double eccentric = anomaly;
    for (int turn = 0; turn < 30; ++turn) eccentric = anomaly + e * std::sin(eccentric);
    const double truly =
        2 * std::atan2(std::sqrt(1 + e) * std::sin(eccentric / 2), std::sqrt(1 - e) * std::cos(eccentric / 2));
    const double node = glm::radians(125.04 - 1934.136 * t);
    const double longitude = glm::radians(mean_longitude - 0.00569 - 0.00478 * std::sin(node)) + truly - anomaly;
    const double tilt = glm::radians(23.439291 - 0.0130042 * t + 0.00256 * std::cos(node));
    const double ascension = std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(tilt) * std::sin(longitude));
    const double sidereal = 280.46061837 + 360.98564736629 * (julian_day - 2451545);
    const double hour = glm::radians(std::fmod(sidereal + place.longitude, 360)) - ascension;
    const double latitude = glm::radians(place.latitude);
    const double up =
        std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour);
    const double north =
        std::cos(latitude) * std::sin(declination) - std::sin(latitude) * std::cos(declination) * std::cos(hour);
    const double east = -std::cos(declination) * std::sin(hour);
    return {glm::degrees(std::asin(up)), glm::degrees(std::atan2(east, north)),
            1.000001018 * (1 - e * std::cos(eccentric))};
}

double julian_day(int year, double day, double hour) {
    double days = 2415019.5;  // 31 December 1899, 0 h
    for (int y = 1900; y < year; ++y) days += y % 4 == 0 && y != 1900 ? 366 : 365;
    return days + day + hour / 24;
}

/// Degrees between two directions of the sky.
double apart(double elevation, double azimuth, double other_elevation, double other_azimuth) {
    const auto vector = [](double up, double round) {
        return glm::dvec3(std::cos(up) * std::cos(round), std::sin(up), std::cos(up) * std::sin(round));
    };
    const glm::dvec3 cross = glm::cross(vector(elevation, azimuth), vector(other_elevation, other_azimuth));
    return glm::degrees(std::asin(glm::length(cross)));
}

}  // namespace

TEST_CASE("the sun stands within 0.01 degrees of Kepler's ellipse from 1950 to 2050", "[sky]") {
    double worst = 0;
    for (int year = 1950; year <= 2050; year += 7) {
        for (double day = 3; day < 366; day += 29.3) {
            const double whole = std::floor(day);
            for (const double hour : {5.2, 11.9, 20.6}) {
                const GroundPlace place{-35 + 0.3 * day, 170 - day, 2};
                const SunPosition sun = sun_position(place, {double(year), whole, hour});
                const Reference exact = kepler(place, julian_day(year, whole, hour - place.zone));
                worst = std::max(worst, apart(sun.elevation, sun.azimuth, glm::radians(exact.elevation),
                                              glm::radians(exact.azimuth)));
                CHECK(sun.distance == Approx(exact.distance).margin(2e-4));
            }
        }
    }
    CHECK(worst < 0.012);
}

TEST_CASE("the sun of NREL's example stands where Reda & Andreas 2004 compute it, without refraction", "[sky]") {
    const SunPosition sun = sun_position({39.742476, -105.1786, -7}, {2003, 290, 12 + 30.5 / 60});
    CHECK(glm::degrees(sun.elevation) == Approx(39.872046).margin(0.01));
    CHECK(glm::degrees(sun.azimuth) + 360 == Approx(194.340241 + 0).margin(0.015).epsilon(0));
}

TEST_CASE("at noon the sun is in the south of the north and in the north of the south, towards `north`", "[sky]") {
    const glm::dvec3 north(0, 0, -1);
    CHECK(towards_sun(sun_position({50, 0, 0}, {2025, 80, 12.1}), north).z > 0.5);
    CHECK(towards_sun(sun_position({-50, 0, 0}, {2025, 80, 12.1}), north).z < -0.5);
    CHECK(towards_sun(sun_position({50, 0, 0}, {2025, 80, 7}), north).x > 0.5);  // east, by cross(north, up)
    CHECK(glm::length(towards_sun(sun_position({50, 0, 0}, {2025, 80, 7}), north)) == Approx(1));
}

TEST_CASE("light above the air changes by 6.9 % in a year, and half of a clear hour's is direct", "[sky]") {
    const double january = extraterrestrial_flux(sun_position({}, {2025, 4, 12}));
    const double july = extraterrestrial_flux(sun_position({}, {2025, 185, 12}));
    CHECK(january / july == Approx(1.069).margin(0.002));
    CHECK(diffuse_share(0) == 1);
    CHECK(diffuse_share(0.22) == Approx(0.9802));
    CHECK(diffuse_share(0.2200001) == Approx(0.9802).margin(0.003));
    CHECK(diffuse_share(0.8) == Approx(0.165).margin(0.002));
    CHECK(diffuse_share(0.9) == 0.165);
    for (double k = 0.01; k < 0.8; k += 0.01) CHECK(diffuse_share(k) <= diffuse_share(k - 0.01) + 1e-3);
}
