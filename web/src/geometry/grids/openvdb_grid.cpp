#include "espalier/geometry/openvdb_grid.h"

#include "espalier/base/error.h"

#include "base/text.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>

namespace espalier::geometry {

void initialize_openvdb() {}

openvdb::math::Transform::Ptr voxel_transform(double voxel) {
    if (voxel < smallest_voxel) {
        throw UserError(fmt::format("voxels of {} m are too small: fields have voxels of {} m or more",
                                    format_general(voxel), format_general(smallest_voxel)));
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
