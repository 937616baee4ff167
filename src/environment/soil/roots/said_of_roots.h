// What a model says of its own roots: their conductances, or their ages.
#pragma once

#include "espalier/environment/environment_process.h"

#include <string>
#include <vector>

namespace espalier::environment {

/// By internode; NaN where the model says nothing, empty where it says nothing at all.
struct SaidOfRoots {
    std::vector<double> radial;  ///< 1/d
    std::vector<double> axial;   ///< cm3/d
    std::vector<double> ages;    ///< days

    /// Reads the queries to `process`, each for the internode before it: the fifth of five parameters is its age, the
    /// fifth and sixth of six are its conductances. Throws RunError for an age or a radial conductance below 0, and an
    /// axial one that is not above 0.
    static SaidOfRoots of(const PlantView& plant, const std::string& process);
};

}  // namespace espalier::environment
