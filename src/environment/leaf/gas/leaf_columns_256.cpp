// Compiled for processors with 256 bits at once (see cmake/stations.cmake); empty for others.
#include "environment/leaf/gas/leaf_column_lanes.h"

namespace espalier::environment::leaf {

#ifdef __AVX2__
const SolveColumns solve_with_256_bits = solve_in_lanes<math::Lanes>;
#endif

}  // namespace espalier::environment::leaf
