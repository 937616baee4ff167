// What passes the upper face of a column: rain, evaporation, ponding and runoff.
#pragma once

#include "environment/soil/richards/cells.h"

namespace espalier::environment {

/// What the weather would do during a substep, cm/d.
struct SurfaceWeather {
    double rain = 0, evaporation = 0;  ///< potential
    double dry_limit = -10000;         ///< cm
    double most_ponding = 0;           ///< cm

    friend bool operator==(const SurfaceWeather&, const SurfaceWeather&) = default;
};

struct SurfaceExchange {
    SoilFlux into;           ///< downwards, cm/d; by_second: with the head of the uppermost voxel
    double ponding = 0;      ///< cm at the end of the substep
    double evaporation = 0;  ///< cm/d, of ponding water and soil
    double runoff = 0;       ///< cm/d
};

/// The soil takes what comes as long as its surface can: the head there does not fall below the dry limit, nor rise
/// above the water that stands on it. What cannot enter stands on the surface up to `most_ponding`, and then runs off.
/// `half`: from the surface to the centre of the uppermost voxel, cm.
SurfaceExchange exchange_at_surface(const SoilHydraulics& soil, const SoilPoint& uppermost, double half,
                                    const SurfaceWeather& weather, double ponding, double days);

}  // namespace espalier::environment
