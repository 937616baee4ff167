// Where the sun stands, and how much light it sends to the top of the atmosphere.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

/// Degrees, positive to the north and to the east; hours of civil time ahead of Greenwich.
struct GroundPlace {
    double latitude = 50, longitude = 0, zone = 0;
};

/// Civil time of a place. `day` counts from 1 on 1 January and may go beyond the year's end.
struct CivilTime {
    double year = 2025, day = 172, hour = 12;
};

/// Radians. The azimuth counts from north through east; refraction by the air, half a degree at the horizon, is left
/// out.
struct SunPosition {
    double elevation, azimuth;
    double distance;  ///< to the sun, in astronomical units
};

/// To 0.01 degrees for the years 1950 to 2050. Michalsky 1988, The Astronomical Almanac's algorithm for approximate
/// solar position (1950-2050), Solar Energy 40:227-235.
SunPosition sun_position(const GroundPlace& place, const CivilTime& time);

/// The unit vector towards the sun. `north` is horizontal and of unit length; y points up.
glm::dvec3 towards_sun(const SunPosition& position, const glm::dvec3& north);

/// Where the sun stands at `samples` times, evenly from sunrise to sunset of each day of 2025 by its number; nothing
/// for days without a sunrise.
std::vector<glm::dvec3> sun_path(double latitude, std::span<const double> days, std::int64_t samples,
                                 const glm::dvec3& north);

/// W/m2 on a plane across the light above the air: 1361 W/m2 (Kopp & Lean 2011) at one astronomical unit.
double extraterrestrial_flux(const SunPosition& position);

/// The diffuse share of the light on level ground of an hour whose clearness index (light on the ground over light
/// above the air, both on a level plane) is `clearness`. Erbs, Klein & Duffie 1982, Solar Energy 28:293-302,
/// equation 1.
double diffuse_share(double clearness);

}  // namespace espalier::environment
