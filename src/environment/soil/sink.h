// What takes water out of a soil while it flows, as roots do.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/soil/cells.h"

#include <span>

namespace espalier::environment {

class SoilSink {
public:
    virtual ~SoilSink() = default;

    /// A step begins: the plants are as they are in `world`.
    virtual void begin(const WorldView& world, const SoilLayout& layout) = 0;
    /// Adds what is taken from each cell, content per day, and how that changes with the cell's head, during `days`
    /// from `day` on. `points` are a Newton step's guess of the soil at the end of that time.
    virtual void draw(std::span<const SoilPoint> points, double day, double days, WaterBrick& uptake,
                      WaterBrick& by_head) = 0;
    /// The last draw holds: the soil has come on by `days`. Of the rate over that time it is the part `weight`; the
    /// rest is the rate over the time before.
    virtual void accept(double days, double weight) = 0;
};

}  // namespace espalier::environment
