// Shade and light as OpenVDB grids, for other processes, recorders and users.
#pragma once

#include "espalier/environment/field.h"

#include "environment/shade_field.h"

#include <string>

namespace espalier {

/// Provides fields `name` (light) and `name`.shade. Voxels that nothing shades are inactive: full light, no shade.
/// `shown`: the voxels a viewer should be shown.
void provide_shade_fields(const ShadeField& field, const ShadeRule& rule, double voxel, const VoxelBox& shown,
                          const std::string& name, Fields& fields);

}  // namespace espalier
