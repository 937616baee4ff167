#pragma once

#include <openvdb/openvdb.h>

#include <type_traits>

namespace openvdb::tools {

struct LayoutXYZ {};  ///< x fastest

/// Values over a box, which belong to the caller.
template <class Value, class Layout>
class Dense {
public:
    Dense(const CoordBBox& box, Value* values) : box_(box), values_(values) {}

    const CoordBBox& bbox() const { return box_; }
    Value& at(const Coord& voxel) const {
        const Coord size = box_.dim(), from = voxel - box_.min();
        const auto part = [](int n) { return static_cast<std::size_t>(n); };
        return values_[(part(from.z()) * part(size.y()) + part(from.y())) * part(size.x()) + part(from.x())];
    }

private:
    CoordBBox box_;
    Value* values_;
};

/// Calls visit(voxel) for each voxel of a box, those of a block together.
template <class Visit>
void for_voxels_by_blocks(const CoordBBox& box, const Visit& visit) {
    const Coord first = box.min().block(FloatLeaf::LOG2DIM);
    for (int x = first.x(); x <= box.max().x(); x += FloatLeaf::DIM) {
        for (int y = first.y(); y <= box.max().y(); y += FloatLeaf::DIM) {
            for (int z = first.z(); z <= box.max().z(); z += FloatLeaf::DIM) {
                CoordBBox part({x, y, z}, Coord(x, y, z).offsetBy(FloatLeaf::DIM - 1));
                part.intersect(box);
                Coord at;
                for (at.x() = part.min().x(); at.x() <= part.max().x(); ++at.x()) {
                    for (at.y() = part.min().y(); at.y() <= part.max().y(); ++at.y()) {
                        for (at.z() = part.min().z(); at.z() <= part.max().z(); ++at.z()) visit(at);
                    }
                }
            }
        }
    }
}

template <class Layout>
void copyToDense(const FloatGrid& grid, Dense<float, Layout>& dense) {
    const FloatGrid::ConstAccessor values = grid.getConstAccessor();
    for_voxels_by_blocks(dense.bbox(), [&](const Coord& voxel) { dense.at(voxel) = values.getValue(voxel); });
}

/// The background's value is not set.
template <class Value, class Layout>
void copyFromDense(const Dense<Value, Layout>& dense, FloatGrid& grid, float) {
    FloatGrid::Accessor values = grid.getAccessor();
    const float background = grid.background();
    for_voxels_by_blocks(dense.bbox(), [&](const Coord& voxel) {
        const float value = dense.at(voxel);
        if (value != background) values.setValue(voxel, value);
    });
}

}  // namespace openvdb::tools
