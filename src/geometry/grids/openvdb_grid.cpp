#include "espalier/geometry/openvdb_grid.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>

namespace openvdb::OPENVDB_VERSION_NAME {
template class tree::InternalNode<tree::LeafNode<float, 3>, 4>;
template class tree::InternalNode<tree::InternalNode<tree::LeafNode<float, 3>, 4>, 5>;
template class tree::Tree<FloatTree::RootNodeType>;
template class Grid<FloatTree>;
}  // namespace openvdb::OPENVDB_VERSION_NAME

namespace espalier::geometry {

void initialize_openvdb() {
    static const bool once = [] {
        openvdb::initialize();
        return true;
    }();
    static_cast<void>(once);
}

openvdb::math::Transform::Ptr voxel_transform(double voxel) {
    constexpr double smallest = 1.5e-5;  // OpenVDB takes a volume below 3e-15 for zero
    if (voxel < smallest) {
        throw UserError(fmt::format("voxels of {} m are too small: fields have voxels of {} m or more",
                                    format_general(voxel), format_general(smallest)));
    }
    return openvdb::math::Transform::createLinearTransform(voxel);
}

openvdb::math::Transform::Ptr cell_centred_transform(double voxel, const glm::dvec3& origin) {
    openvdb::math::Transform::Ptr transform = voxel_transform(voxel);
    const glm::dvec3 centre = origin + 0.5 * voxel;
    transform->postTranslate(openvdb::Vec3d(centre.x, centre.y, centre.z));
    return transform;
}

}  // namespace espalier::geometry
