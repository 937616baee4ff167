// What a point or a cell of plants/NNNN.vtp shows.
#pragma once

#include "espalier/base/stations.h"

#include <cstdint>

namespace espalier::geometry {

enum class Kind : std::uint8_t { query = 0, axis = 1, polygon = 2, organ = 3, cylinder = 4, patch = 5, label = 6 };

}  // namespace espalier::geometry
