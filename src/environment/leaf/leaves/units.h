// Units in which leaves tell what they did.
#pragma once

#include "environment/leaf/gas/air.h"

namespace espalier::environment::leaf {

inline constexpr double seconds_per_day = 86400;
inline constexpr double cm3_of_mole = 1000 * water_molar_mass / water_density;  ///< of water

}  // namespace espalier::environment::leaf
