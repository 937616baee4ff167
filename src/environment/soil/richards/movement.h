// What moved in a substep of a soil's water, for solutes that move with it.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/richards/cells.h"

#include <array>
#include <iosfwd>
#include <vector>

namespace espalier::environment {

class SoilFluxes;

/// Mean rates over a substep: with them the contents change by exactly what passes the faces, but for the water that
/// sources bring.
struct SoilMovement {
    double day = 0, days = 0;        ///< when the substep began, and its length
    std::array<WaterBrick, 3> flux;  ///< through the faces towards +x, +y and +z, cm/d
    WaterBrick uptake;               ///< by roots, content per day
    std::vector<double> floor;       ///< upwards through the lowest faces, cm/d, per column
    std::vector<double> surface;     ///< downwards into the soil, cm/d, per column
    WaterBrick sides;                ///< into voxels at sides of given heads, cm/d; empty where there are none

    void resize(const WaterGrid& grid, bool has_side_heads = false);
    /// A substep of `span` days from `begin` on has passed, of whose mean rates these are the part `weight`; the rest
    /// are the rates before.
    void pass(double begin, double span, double weight, const SoilLayout& layout, const SoilFluxes& fluxes,
              const WaterBrick& taken);
    void save(std::ostream& out) const;
    void restore(std::istream& in);
};

/// Brings `mean` on: of the rate over a substep `now` is the part `weight`, the rest is the rate before.
inline void bring_on(double& mean, double now, double weight) {
    mean = weight * now + (1 - weight) * mean;
}

/// What follows the water.
class SoilFollower {
public:
    virtual ~SoilFollower() = default;
    /// A step begins with these contents; the plants are as they are in `world`.
    virtual void begin(const WorldView& world, const WaterBrick& contents) = 0;
    /// The soil has come on by a substep, to these contents.
    virtual void follow(const SoilMovement& movement, const WaterBrick& contents) = 0;
};

}  // namespace espalier::environment
