#include "geometry/grids/voxel_values.h"

#include "espalier/geometry/openvdb_grid.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>

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

VoxelValues::VoxelValues(double voxel, const glm::dvec3& origin, float unset) {
    initialize_openvdb();
    auto field = std::make_shared<FieldGrid>();
    field->grid = openvdb::FloatGrid::create(unset);
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

std::span<float> VoxelValues::row(const glm::ivec3& at, int most) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    constexpr int edge = Leaf::DIM;
    const openvdb::Coord voxel = writing_->shown(at);
    Leaf& leaf = *writing_->values.touchLeaf(voxel);
    const openvdb::Index first = Leaf::coordToOffset(voxel);
    const int count = std::min(most, edge - (at.z & (edge - 1)));
    for (int k = 0; k < count; ++k) leaf.setValueOn(first + static_cast<openvdb::Index>(k));
    writing_->shown({at.x, at.y, at.z + count - 1});
    return {leaf.buffer().data() + first, static_cast<std::size_t>(count)};
}

void VoxelValues::fill(const glm::ivec3& size, std::span<const float> values) {
    show({0, 0, 0}, size - 1);
    const openvdb::CoordBBox box({0, 0, 0}, {size.x - 1, size.y - 1, size.z - 1});
    const openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ> dense(box, values.data());
    openvdb::tools::copyFromDense(dense, *writing_->field->grid, 0.0f);
}

void VoxelValues::show(const glm::ivec3& least, const glm::ivec3& most) {
    writing_->shown(least);
    writing_->shown(most);
}

std::shared_ptr<const FieldGrid> VoxelValues::grid() const {
    return writing_->field;
}

struct VoxelReader::Reading {
    std::shared_ptr<const FieldGrid> field;
    openvdb::FloatGrid::ConstAccessor values;
};

VoxelReader::VoxelReader(std::shared_ptr<const FieldGrid> field)
    : reading_(new Reading{field, field->grid->getConstAccessor()}) {}

VoxelReader::~VoxelReader() = default;

float VoxelReader::value(const glm::dvec3& place) const {
    const openvdb::Vec3d index =
        reading_->field->grid->transform().worldToIndex(openvdb::Vec3d(place.x, place.y, place.z));
    return reading_->values.getValue(openvdb::Coord::round(index));
}

double VoxelReader::between(const glm::dvec3& index) const {
    return openvdb::tools::BoxSampler::sample(reading_->values, openvdb::Vec3d(index.x, index.y, index.z));
}

std::size_t bytes_held(const FieldGrid& field) {
    return field.grid->memUsage();
}

}  // namespace espalier::geometry
