// Transpiration of a leaf by the combination equation, without the temperature of the leaf.
#pragma once

#include "environment/leaf/gas/gas_exchange.h"

namespace espalier::environment::leaf {

/// Monteith (1965), as Campbell & Norman (1998, eq. 14.12) write it for a leaf with stomata on one side, mol m-2 s-1:
/// the energy is linear in the leaf's temperature about that of the air. `conductance` is that of the stomata to
/// vapour.
double penman_monteith(const LeafKind& leaf, const LeafLight& light, const Air& air, double conductance);

}  // namespace espalier::environment::leaf
