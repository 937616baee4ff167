// Days as rows of a quarter of an hour: the usual curves of a day.
#pragma once

#include "environment/given/weather/weather_table.h"

namespace espalier::environment {

/// Temperature goes along half cosines from the lowest at sunrise to the highest two hours after noon by the sun, and
/// to the lowest of the next day (de Wit et al. 1978, Simulation of assimilation, respiration and transpiration of
/// crops). Radiation follows the sine of the sun's height, and has the day's mean. The vapour pressure is that of the
/// day's humidity at its mean temperature; without humidity the air is saturated at the lowest one (Allen et al. 1998,
/// eq. 48). Rain falls evenly over the day, and wind blows so. Throws UserError naming the line of a day of which the
/// lowest temperature is above the highest, or that has radiation where the sun does not rise.
WeatherTable course_of_days(const WeatherTable& days, const GroundPlace& place, double year, double day);

}  // namespace espalier::environment
