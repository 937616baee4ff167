// Compiled for processors with 512 bits at once (see cmake/stations.cmake); empty for others.
#include "environment/leaf/gas/leaf_column_lanes.h"

namespace espalier::environment::leaf {

#ifdef __AVX512F__
const SolveColumns solve_with_512_bits = solve_in_lanes<math::Lanes>;
#endif

}  // namespace espalier::environment::leaf
