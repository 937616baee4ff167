// Grids whose inactive voxels hold nothing: soil outside its domain, or inside a stone.
#pragma once

#include <openvdb/openvdb.h>

namespace espalier::geometry {

/// Values between voxels are from now on those of the active ones alone.
inline void use_only_active_values(openvdb::FloatGrid& grid) {
    grid.only_active_values = true;
}

inline bool has_only_active_values(const openvdb::FloatGrid& grid) {
    return grid.only_active_values;
}

}  // namespace espalier::geometry
