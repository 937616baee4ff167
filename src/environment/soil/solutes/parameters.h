// What a scene says about a solute, read and checked.
#pragma once

#include "environment/soil/richards/parameters.h"
#include "environment/soil/solutes/root_uptake.h"
#include "environment/soil/solutes/transport.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// A part of the soil: between two heights, or of a shape.
struct SolutePart {
    double bottom = 0, top = 0;          ///< m
    std::shared_ptr<const Shape> shape;  ///< null: between the heights

    bool inside(const glm::dvec3& point) const;
};

struct SoluteBeginning {
    SolutePart part;
    double concentration = 0;
};

/// Mineralisation: amount per cm3 of soil and day.
struct SoluteSource {
    SolutePart part;
    double rate = 0;
    Place place;
};

/// Fertiliser: an amount that is spread evenly over a part of the soil on a day.
struct SoluteEvent {
    SolutePart part;
    double day = 0, amount = 0;
    Place place;
};

struct SoluteParameters {
    SoilParameters soil;  ///< the space, without a soil of its own to flow in
    double content = 0.3, flow = 0;
    SoluteProperties properties;
    std::string unit;
    double decay = 0;  ///< 1/d
    double initial = 0;
    std::vector<SoluteBeginning> beginnings;
    std::vector<SoluteSource> sources;
    std::vector<SoluteEvent> events;  ///< by rising day
    TimeSeries rain;                  ///< concentration of water that enters at the top
    SoluteSides sides;
    UptakeKinetics kinetics;
    bool zone = true;
    double max_substep = 0.05;  ///< days
};

/// `alone`: without a soil-water of model = "richards", whose space it would take. Throws UserError.
SoluteParameters read_solute_parameters(Settings& settings, const EnvironmentContext& context, bool alone);

/// What `espalier list` prints of process nutrient.
extern const char* const nutrient_help;

}  // namespace espalier::environment
