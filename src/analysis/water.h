// What a run says of the water of its plants: uptake of internodes, and the days on which roots could not meet a
// demand.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <limits>
#include <span>
#include <vector>

namespace espalier::analysis {

/// The uptake of each internode, cm3/d: of what `timeline.organs` recorded, a mean_uptake or else an uptake. The pieces
/// of a module share what it takes by their lengths. Empty where none was recorded.
std::vector<double> uptakes_of(const FrameGeometry& geometry, std::span<const FrameInternode> internodes);

/// A plant whose transpiration falls below its demand is stressed.
struct WaterStress {
    std::uint32_t plant = 0;
    double first_time = std::numeric_limits<double>::quiet_NaN();  ///< end of the first step with stress; NaN: none
    double time = 0;                                               ///< of all steps with stress
    double transpired = 0, demanded = 0;                           ///< sums of rates times steps
};

/// One for each plant whose process told its transpiration and its demand. Throws UserError for a damaged table.
std::vector<WaterStress> water_stress(const RecordedTable& statistics, double dt);

}  // namespace espalier::analysis
