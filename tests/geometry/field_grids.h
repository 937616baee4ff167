// Grids of known functions, as processes publish them.
#pragma once

#include "espalier/geometry/openvdb_grid.h"

#include <functional>
#include <string>

namespace espalier::test {

/// A field with the values of a function at the centres of its voxels, in a cube about the origin.
inline Field field_of(const std::string& name, double voxel, int reach,
                      const std::function<double(const glm::dvec3&)>& function) {
    initialize_openvdb();
    const auto grid = openvdb::FloatGrid::create(0);
    grid->setTransform(cell_centred_transform(voxel, glm::dvec3(-0.5 * voxel)));
    const openvdb::CoordBBox box(openvdb::Coord(-reach), openvdb::Coord(reach));
    for (auto at = box.beginZYX(); at; ++at) {
        const openvdb::Vec3d place = grid->indexToWorld(*at);
        grid->tree().setValue(*at, static_cast<float>(function({place.x(), place.y(), place.z()})));
    }
    return {name, "1", "of a test", std::make_shared<FieldGrid>(FieldGrid{grid, box})};
}

}  // namespace espalier::test
