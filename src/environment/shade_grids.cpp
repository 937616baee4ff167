#include "environment/shade_grids.h"

#include "espalier/environment/openvdb_grid.h"

#include <tbb/parallel_for.h>

namespace espalier {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == ShadeField::brick_edge && Leaf::SIZE == ShadeField::brick_voxels);

openvdb::Coord coord(const glm::ivec3& voxel) {
    return {voxel.x, voxel.y, voxel.z};
}

// Values and their mask as plain memory: a call per voxel would take longer than the shade itself.
template <class Value>
void fill(Leaf& leaf, std::span<const Shade> sums, const Value& value) {
    float* const values = leaf.buffer().data();
    Leaf::NodeMaskType active;
    for (openvdb::Index word = 0; word < Leaf::NodeMaskType::WORD_COUNT; ++word) {
        std::uint64_t bits = 0;
        for (openvdb::Index bit = 0; bit < 64; ++bit) {
            const openvdb::Index voxel = 64 * word + bit;
            if (sums[voxel] == 0) continue;
            values[voxel] = static_cast<float>(value(sums[voxel]));
            bits |= std::uint64_t(1) << bit;
        }
        active.getWord<openvdb::Index64>(word) = bits;
    }
    leaf.setValueMask(active);
}

template <class Value>
std::shared_ptr<const FieldGrid> grid_of(const ShadeField& field, double voxel, const std::string& name,
                                         const VoxelBox& box, const Value& value) {
    const auto background = static_cast<float>(value(0));
    std::vector<std::unique_ptr<Leaf>> leaves(field.bricks());
    tbb::parallel_for(std::size_t(0), leaves.size(), [&](std::size_t brick) {
        leaves[brick] = std::make_unique<Leaf>(coord(field.origin(brick)), background);
        fill(*leaves[brick], field.sums(brick), value);
    });
    auto result = std::make_shared<FieldGrid>();
    result->grid = openvdb::FloatGrid::create(background);
    for (std::unique_ptr<Leaf>& leaf : leaves) result->grid->tree().addLeaf(leaf.release());
    result->grid->setTransform(cell_centred_transform(voxel, glm::dvec3(-0.5 * voxel)));
    result->grid->setName(name);
    result->box = openvdb::CoordBBox(coord(box.lower), coord(box.upper));
    return result;
}

}  // namespace

void provide_shade_fields(const ShadeField& field, const ShadeRule& rule, double voxel, const VoxelBox& shown,
                          const std::string& name, Fields& fields) {
    initialize_openvdb();
    // A viewer of an empty field still needs something to show: the voxel at the origin.
    const VoxelBox box = shown.empty() ? VoxelBox{glm::ivec3(0), glm::ivec3(0)} : shown;
    const std::string shade = name + ".shade";
    fields.provide({name, "1", "light: what full light the shadows leave",
                    grid_of(field, voxel, name, box, [&](Shade s) { return light_under(rule, s); }), true});
    fields.provide({shade, "1", rule.attenuate ? "optical depth of all shadows" : "sum of all shadows",
                    grid_of(field, voxel, shade, box, shade_value), true});
}

}  // namespace espalier
