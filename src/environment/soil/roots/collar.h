// What the shoot asks of the roots: a potential, or water.
#pragma once

#include "espalier/base/settings.h"

#include "environment/given/weather/time_series.h"
#include "environment/soil/roots/hydraulic_tree.h"

#include <string>

namespace espalier::environment {

struct RootCollar {
    bool held = false;      ///< at `head`; else it transpires
    TimeSeries head;        ///< pressure head at the collar, cm
    TimeSeries demand;      ///< potential transpiration, cm3/d for each plant
    double limit = -15000;  ///< cm: no demand draws the collar lower
    std::string leaves;     ///< the process whose leaves say the demand; "": `demand` does
    bool by_day = false;    ///< the demand follows a sine from 6 to 18 o'clock; its mean is `demand`

    static RootCollar read(const Settings& settings);
    /// The mean demand of a span of time, cm3/d; of no days: the demand at that moment.
    double mean_demand(double day, double days) const;
    /// What jumps where the demand or the held head does: at sunrise and sunset, and where a series changes.
    double level(double day) const;
    /// The longest span that shows how the demand changes.
    double longest_span(double day) const;
};

/// A shoot that is solved with the roots.
class CollarEnd {
public:
    virtual ~CollarEnd() = default;
    /// Returns the total head at the collar, cm, where the shoot takes what the roots supply.
    virtual double meet(const CollarView& supply) = 0;
    /// How much more it takes where that head rises, cm2/d.
    virtual double by_head() const = 0;
};

}  // namespace espalier::environment
