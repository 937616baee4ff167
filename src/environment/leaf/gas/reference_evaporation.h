// What a short lawn that lacks no water evaporates in a day: FAO-56 (Allen, Pereira, Raes & Smith 1998).
#pragma once

#include <optional>

namespace espalier::environment::leaf {

struct DayOfAir {
    double highest = 25, lowest = 15;  ///< temperature, degrees Celsius
    double vapour_pressure = 1.5;      ///< kPa
    double wind = 2;                   ///< 2 m above the ground, m s-1
    double sunshine = 8;               ///< hours
    double latitude = 50;              ///< degrees, positive in the north
    double height = 0;                 ///< above the sea, m
    int day = 180;                     ///< of the year, from 1
    std::optional<double> radiation;   ///< of the sun on level ground, MJ m-2 d-1; none: by the hours of sunshine
};

struct ReferenceEvaporation {
    double net_radiation = 0;  ///< MJ m-2 d-1
    double evaporation = 0;    ///< mm d-1
};

ReferenceEvaporation reference_evaporation(const DayOfAir& day);

}  // namespace espalier::environment::leaf
