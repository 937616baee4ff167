// What a Field holds in a page: the small grid of web/include/openvdb/openvdb.h.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/field.h"

#include <openvdb/openvdb.h>

namespace espalier::geometry {

struct FieldGrid {
    openvdb::FloatGrid::Ptr grid;  ///< index space to metres by its transform; voxel centres are at integer indices
    openvdb::CoordBBox box;        ///< the voxels a viewer should be shown: the domain, or what is active
    bool only_leaves = false;      ///< what is in no leaf is inactive and the background's
};

/// Nothing here.
void initialize_openvdb();

/// As on a machine, with the same limit.
openvdb::math::Transform::Ptr voxel_transform(double voxel);
openvdb::math::Transform::Ptr cell_centred_transform(double voxel, const glm::dvec3& origin);

}  // namespace espalier::geometry
