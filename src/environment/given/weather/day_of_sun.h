// The sun's day at a place.
#pragma once

#include "environment/light/sun/sun.h"

namespace espalier::environment {

/// Hours of civil time; they may lie before 0 or behind 24 where the zone is far from the place's.
struct DayOfSun {
    double noon = 12;
    double rise = 6, set = 18;  ///< both noon where the sun does not rise; 12 hours from noon where it does not set
    double length() const { return set - rise; }
};

/// `below`: degrees below the horizon at which the day begins and ends; 0.833 for the sun's upper edge in refracting
/// air, 6 for civil twilight. `day` counts from 1 on 1 January.
DayOfSun day_of_sun(const GroundPlace& place, double year, double day, double below = 0.833);

}  // namespace espalier::environment
