#include "environment/space/shapes/field.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"
#include "environment/exchange/covering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace espalier::environment {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr double half_band = 3;        // voxels on either side of the surface, OpenVDB's custom
constexpr int block_edge = Leaf::DIM;  // voxels
constexpr std::size_t leaf_bytes = sizeof(Leaf) + Leaf::SIZE * sizeof(float);

/// Finds the blocks of 8^3 voxels that the band passes through, halving larger blocks: a block whose centre is farther
/// from the surface than its corners are from the centre holds none of it.
class BandBlocks {
public:
    BandBlocks(const Shape& shape, const openvdb::math::Transform& transform, double voxel, std::size_t most)
        : shape_(shape), transform_(transform), voxel_(voxel), most_(most) {}

    /// False if there are more than `most`.
    bool collect(const openvdb::Coord& origin, int edge, const openvdb::CoordBBox& within) {
        const openvdb::CoordBBox block(origin, origin.offsetBy(edge - 1));
        if (!block.hasOverlap(within)) return true;
        check_stop_();
        const double half = 0.5 * (edge - 1);
        const openvdb::Vec3d at = transform_.indexToWorld(origin.asVec3d() + openvdb::Vec3d(half));
        const double distance = shape_.distance({at.x(), at.y(), at.z()});
        if (std::abs(distance) > (std::sqrt(3.0) * (half + 1) + half_band) * voxel_) {
            if (distance < 0) inside.push_back(block);
            return true;
        }
        if (edge == block_edge) {
            leaves.push_back(origin);
            return leaves.size() <= most_;
        }
        for (int child = 0; child < 8; ++child) {
            const int step = edge / 2;
            const openvdb::Coord child_origin =
                origin.offsetBy(child & 1 ? step : 0, child & 2 ? step : 0, child & 4 ? step : 0);
            if (!collect(child_origin, step, within)) return false;
        }
        return true;
    }

    std::vector<openvdb::Coord> leaves;
    std::vector<openvdb::CoordBBox> inside;  ///< blocks wholly inside

private:
    const Shape& shape_;
    const openvdb::math::Transform& transform_;
    double voxel_;
    std::size_t most_;
    StopCheck<1024> check_stop_;
};

void sample_leaf(Leaf& leaf, const Shape& shape, const openvdb::math::Transform& transform, float background) {
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
        const openvdb::Vec3d at = transform.indexToWorld(leaf.offsetToGlobalCoord(i).asVec3d());
        const auto distance = static_cast<float>(shape.distance({at.x(), at.y(), at.z()}));
        if (std::abs(distance) < background) {
            leaf.setValueOn(i, distance);
        } else {
            leaf.setValueOff(i, std::copysign(background, distance));
        }
    }
}

openvdb::CoordBBox voxels_of(const Box& box, double voxel, const Place& place) {
    const glm::dvec3 count = voxels_over(box, voxel);
    openvdb::Coord upper;
    for (int i = 0; i < 3; ++i) {
        if (!(count[i] < 1 << 28)) {
            throw UserError(place, fmt::format("voxels of {:g} m are too small for a box of {:g} m", voxel,
                                               box.upper[i] - box.lower[i]));
        }
        upper[i] = static_cast<int>(count[i]) - 1;
    }
    return {openvdb::Coord(0), upper};
}

}  // namespace

std::shared_ptr<const FieldGrid> sample_level_set(const Shape& shape, const Box& box, double voxel, std::size_t memory,
                                                  const Place& place) {
    initialize_openvdb();
    const openvdb::CoordBBox voxels = voxels_of(box, voxel, place);
    const auto transform = cell_centred_transform(voxel, lower_corner_over(box, voxel));
    const auto background = static_cast<float>(half_band * voxel);
    auto grid = openvdb::FloatGrid::create(background);
    grid->setTransform(transform);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);

    BandBlocks band(shape, *transform, voxel, memory / leaf_bytes);
    int edge = block_edge;
    while (edge < voxels.dim()[voxels.maxExtent()]) edge *= 2;
    if (!band.collect(openvdb::Coord(0), edge, voxels)) {
        throw UserError(place, fmt::format("the distance field would take more than {:.3g} GB at voxels of {:g} m; "
                                           "a larger 'voxel' needs less",
                                           static_cast<double>(memory) / 1e9, voxel));
    }
    for (const openvdb::CoordBBox& block : band.inside) grid->tree().fill(block, -background, false);
    std::vector<std::unique_ptr<Leaf>> leaves(band.leaves.size());
    for_in_parallel(std::size_t{0}, leaves.size(), [&](std::size_t i) {
        leaves[i] = std::make_unique<Leaf>(band.leaves[i], background);
        sample_leaf(*leaves[i], shape, *transform, background);
    });
    for (std::unique_ptr<Leaf>& leaf : leaves) grid->tree().addLeaf(leaf.release());
    return std::make_shared<const FieldGrid>(FieldGrid{grid, voxels});
}

}  // namespace espalier::environment
