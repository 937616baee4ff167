#include "geometry/grids/voxel_values.h"

#include "espalier/geometry/openvdb_grid.h"

namespace espalier::geometry {

struct VoxelValues::Writing {
    std::shared_ptr<FieldGrid> field;
    openvdb::FloatGrid::Accessor values;

    openvdb::Coord shown(const glm::ivec3& at) {
        const openvdb::Coord voxel(at.x, at.y, at.z);
        field->box.expand(voxel);
        return voxel;
    }
};

VoxelValues::VoxelValues(double voxel, const glm::dvec3& origin) {
    initialize_openvdb();
    auto field = std::make_shared<FieldGrid>();
    field->grid = openvdb::FloatGrid::create(0);
    field->grid->setTransform(cell_centred_transform(voxel, origin));
    writing_ = std::make_unique<Writing>(Writing{field, field->grid->getAccessor()});
}

VoxelValues::~VoxelValues() = default;

void VoxelValues::set(const glm::ivec3& at, float value) {
    writing_->values.setValue(writing_->shown(at), value);
}

void VoxelValues::add(const glm::ivec3& at, float value) {
    const openvdb::Coord voxel = writing_->shown(at);
    writing_->values.setValue(voxel, writing_->values.getValue(voxel) + value);
}

void VoxelValues::show(const glm::ivec3& least, const glm::ivec3& most) {
    writing_->shown(least);
    writing_->shown(most);
}

std::shared_ptr<const FieldGrid> VoxelValues::grid() const {
    return writing_->field;
}

}  // namespace espalier::geometry
