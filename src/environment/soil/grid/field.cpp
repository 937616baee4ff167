#include "environment/soil/grid/field.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/holders.h"
#include "base/parallel.h"
#include "geometry/grids/active_values.h"

#include <openvdb/tree/LeafManager.h>

namespace espalier::environment {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

openvdb::CoordBBox box_of(const WaterGrid& grid) {
    const glm::ivec3 size = grid.size();
    return {openvdb::Coord(0, 0, 0), openvdb::Coord(size.x - 1, size.y - 1, size.z - 1)};
}

/// Calls visit(offset in the leaf, cell of the brick) for every voxel of the leaf in the box.
template <class Visit>
void for_voxels(const Leaf& leaf, const WaterGrid& grid, Visit visit) {
    openvdb::CoordBBox box = leaf.getNodeBoundingBox();
    box.intersect(box_of(grid));
    for (int x = box.min().x(); x <= box.max().x(); ++x) {
        for (int y = box.min().y(); y <= box.max().y(); ++y) {
            for (int z = box.min().z(); z <= box.max().z(); ++z) {
                visit(Leaf::coordToOffset(openvdb::Coord(x, y, z)), grid.cell({x, y, z}));
            }
        }
    }
}

/// Calls visit(leaf) for every leaf, on several threads.
template <class Visit>
void for_leaves(openvdb::FloatTree& tree, Visit visit) {
    openvdb::tree::LeafManager<openvdb::FloatTree> leaves(tree);
    for_in_parallel(std::size_t{0}, leaves.leafCount(), [&](std::size_t i) { visit(leaves.leaf(i)); });
}

void write(const WaterBrick& contents, const WaterGrid& grid, openvdb::FloatTree& tree) {
    for_leaves(tree, [&](Leaf& leaf) {
        float* values = leaf.buffer().data();
        for_voxels(leaf, grid, [&](openvdb::Index offset, std::size_t cell) {
            values[offset] = static_cast<float>(contents[cell]);
        });
    });
}

}  // namespace

WaterField::WaterField(std::string name, std::string unit, const WaterGrid& grid, std::string meaning)
    : name_(std::move(name)), unit_(std::move(unit)), meaning_(std::move(meaning)), grid_(grid) {
    initialize_openvdb();
}

void WaterField::set_faces(const WaterFaces& faces) {
    auto grid = openvdb::FloatGrid::create(0);
    grid->setName(name_);
    grid->setTransform(cell_centred_transform(grid_.voxel(), grid_.lower()));
    grid->tree().denseFill(box_of(grid_), 0, true);
    use_only_active_values(*grid);
    for_leaves(grid->tree(), [&](Leaf& leaf) {
        for_voxels(leaf, grid_, [&](openvdb::Index offset, std::size_t cell) {
            if (!faces.free(cell)) leaf.setValueOff(offset);
        });
    });
    topology_ = std::make_shared<FieldGrid>(FieldGrid{grid, box_of(grid_)});
    published_.reset();
    stale_ = true;
}

void WaterField::provide(std::function<const WaterBrick&()> contents, Fields& fields, FieldSource* source) {
    contents_ = std::move(contents);
    fields.provide({name_, unit_, meaning_, current(), true, [this] { return current(); }, source});
}

std::shared_ptr<const FieldGrid> WaterField::current() {
    if (!stale_) return published_;
    // With more holders than the field and ourselves, someone reads the grid of a step before: it is left to them.
    if (published_ == nullptr || is_held_by_others(published_, 2) || is_held_by_others(published_->grid, 1)) {
        published_ = std::make_shared<FieldGrid>(FieldGrid{topology_->grid->deepCopy(), topology_->box});
    }
    write(contents_(), grid_, published_->grid->tree());
    stale_ = false;
    return published_;
}

}  // namespace espalier::environment
