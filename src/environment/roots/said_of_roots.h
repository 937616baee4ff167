// Conductances that a model says of its own roots.
#pragma once

#include "espalier/environment/environment_process.h"

#include <string>
#include <vector>

namespace espalier::environment {

/// By internode; NaN where the model says nothing, empty where it says nothing at all.
struct SaidConductances {
    std::vector<double> radial;  ///< 1/d
    std::vector<double> axial;   ///< cm3/d

    /// Reads the fifth and sixth parameter of the queries to `process`, each for the internode before it. Throws
    /// RunError for a radial one below 0, and an axial one that is not above 0.
    static SaidConductances of(const PlantView& plant, const std::string& process);
};

}  // namespace espalier::environment
