// What a Field holds. Include this only where grids are made, sampled or written: it includes OpenVDB.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/field.h"

#include <openvdb/openvdb.h>

// The tree of a FloatGrid is compiled once, in the library of grids: six seconds less in each file that makes or reads
// one.
namespace openvdb::OPENVDB_VERSION_NAME {
extern template class tree::InternalNode<tree::LeafNode<float, 3>, 4>;
extern template class tree::InternalNode<tree::InternalNode<tree::LeafNode<float, 3>, 4>, 5>;
extern template class tree::Tree<FloatTree::RootNodeType>;
extern template class Grid<FloatTree>;
}  // namespace openvdb::OPENVDB_VERSION_NAME

namespace espalier::geometry {

struct FieldGrid {
    openvdb::FloatGrid::Ptr grid;  ///< index space to metres by its transform; voxel centres are at integer indices
    openvdb::CoordBBox box;        ///< the voxels a viewer should be shown (.vti): the domain, or what is active
    bool only_leaves = false;      ///< what is in no leaf is inactive and the background's: then it is written faster
};

/// openvdb::initialize(), once.
void initialize_openvdb();

/// A grid of uniform voxels whose voxel (0,0,0) has its centre at the origin. Throws UserError for voxels that are
/// smaller than OpenVDB allows, 1.5e-5 m.
openvdb::math::Transform::Ptr voxel_transform(double voxel);

/// The same with voxel (0,0,0) at `origin` + voxel/2.
openvdb::math::Transform::Ptr cell_centred_transform(double voxel, const glm::dvec3& origin);

}  // namespace espalier::geometry
