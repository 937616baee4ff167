// Compiled for processors with 512 bits at once (see cmake/stations.cmake); empty for others.
#include "environment/leaf/gas/leaf_column_lanes.h"

#ifdef __AVX512F__
const espalier::environment::leaf::SolveColumns espalier::environment::leaf::solve_with_512_bits =
    solve_in_lanes<espalier::math::Lanes>;
#endif
