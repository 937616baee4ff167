// Compiled for processors with 256 bits at once (see cmake/stations.cmake); empty for others.
#include "base/math_lanes.h"

#ifdef __AVX2__
const espalier::math::ColumnFunctions espalier::math::functions_of_256_bits = column_functions<Lanes>();
#endif
