// Compiled for processors with 256 bits at once (see cmake/stations.cmake); empty for others.
#include "environment/leaf/gas/leaf_column_lanes.h"

#ifdef __AVX2__
const espalier::environment::leaf::SolveColumns espalier::environment::leaf::solve_with_256_bits =
    solve_in_lanes<espalier::math::Lanes>;
#endif
