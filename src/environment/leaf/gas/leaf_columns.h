// Leaves of one kind side by side: to the last bit what gas_exchange.h gives for each alone, as many at once as the
// processor's vectors hold.
#pragma once

#include "environment/leaf/gas/gas_exchange.h"

#include <cstddef>
#include <vector>

namespace espalier::environment::leaf {

/// Columns that begin at one leaf each. What goes in may be null: then all leaves have what the kind has.
struct LeafColumns {
    std::size_t count = 0;
    const double *photons, *near_infrared, *thermal, *potential;
    const double *carboxylation, *electron_transport, *respiration, *slope, *width;
    double *assimilation, *transpiration, *conductance, *temperature, *internal, *deficit, *sent;
    double* by_potential;  ///< of the transpiration, mol m-2 s-1 MPa-1; null: not asked for
    double* residual;      ///< the largest
};

using SolveColumns = void (*)(const LeafKind& kind, const Air& air, const LeafColumns& columns);

/// What each of this processor's widths of vectors solves them with; the widest is the last.
std::vector<SolveColumns> solvers_here();

/// Solves all leaves with the widest vectors. Throws RunError as gas_exchange() for the first leaf that finds no
/// temperature.
void solve(const LeafKind& kind, const Air& air, const LeafColumns& columns);

}  // namespace espalier::environment::leaf
