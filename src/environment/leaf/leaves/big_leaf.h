// A plant as one leaf, for comparison with its leaves one by one.
#pragma once

#include "environment/leaf/leaves/plant_leaves.h"

namespace espalier::environment::leaf {

struct BigLeaf {
    double gain_rate = 0, water_rate = 0;  ///< net CO2, mol/d; cm3/d
    double by_formula = 0;                 ///< water by Penman & Monteith's equation, cm3/d
};

/// One leaf of this kind with the area of all, in the mean of their light, with the means of what the model says of
/// them, of their potentials, and for the formula of their conductances.
BigLeaf big_leaf(const PlantLeaves& leaves, LeafKind kind, const Air& air, double thermal);

}  // namespace espalier::environment::leaf
