#include "environment/given/weather/day_of_sun.h"

#include "espalier/base/math.h"

#include <numbers>

namespace espalier::environment {

DayOfSun day_of_sun(const GroundPlace& place, double year, double day, double below) {
    const auto position = [&](double hour) { return sun_position(place, {year, day, hour}); };
    DayOfSun sun;
    sun.noon = 12 + place.zone - place.longitude / 15;
    // Noon is where the sun stands due north or south; the equation of time moves it by 17 minutes at most.
    double early = sun.noon - 0.5, late = sun.noon + 0.5;
    const auto east = [&](double hour) { return math::sin(position(hour).azimuth) > 0; };
    const bool moves_west = east(early) && !east(late);
    for (int turn = 0; turn < 40 && moves_west; ++turn) (east((early + late) / 2) ? early : late) = (early + late) / 2;
    if (moves_west) sun.noon = (early + late) / 2;
    const double limit = -below * std::numbers::pi / 180;
    const auto is_up = [&](double hour) { return position(hour).elevation > limit; };
    const auto horizon = [&](double dark, double light) {
        for (int turn = 0; turn < 40; ++turn) (is_up((dark + light) / 2) ? light : dark) = (dark + light) / 2;
        return (dark + light) / 2;
    };
    if (!is_up(sun.noon)) {
        sun.rise = sun.set = sun.noon;
    } else {
        sun.rise = is_up(sun.noon - 12) ? sun.noon - 12 : horizon(sun.noon - 12, sun.noon);
        sun.set = is_up(sun.noon + 12) ? sun.noon + 12 : horizon(sun.noon + 12, sun.noon);
    }
    return sun;
}

}  // namespace espalier::environment
