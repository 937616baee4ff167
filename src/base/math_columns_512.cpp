// Compiled for processors with 512 bits at once (see cmake/stations.cmake); empty for others.
#include "base/math_lanes.h"

#ifdef __AVX512F__
const espalier::math::ColumnFunctions espalier::math::functions_of_512_bits = column_functions<Lanes>();
#endif
