#include "environment/light/shade/grids.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/holders.h"
#include "base/parallel.h"

#include <algorithm>

namespace espalier::environment {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
static_assert(Leaf::DIM == ShadeBricks::edge && Leaf::SIZE == ShadeBricks::voxels);

openvdb::Coord coord(const glm::ivec3& voxel) {
    return {voxel.x, voxel.y, voxel.z};
}

openvdb::Coord origin_of(const glm::ivec3& brick) {
    return coord(brick * ShadeBricks::edge);
}

/// Removes a leaf and what of the nodes above it has become empty: a tree made from nothing would not have them either.
void remove_leaf(Tree& tree, const openvdb::Coord& at) {
    using Lower = Tree::RootNodeType::ChildNodeType::ChildNodeType;
    using Upper = Tree::RootNodeType::ChildNodeType;
    const float background = tree.background();
    tree.addTile(1, at, background, false);
    const Lower* lower = tree.probeConstNode<Lower>(at);
    if (lower == nullptr || !lower->getChildMask().isOff()) return;
    tree.addTile(2, at, background, false);
    const Upper* upper = tree.probeConstNode<Upper>(at);
    if (upper == nullptr || !upper->getChildMask().isOff()) return;
    tree.addTile(3, at, background, false);
    tree.root().eraseBackgroundTiles();
}

}  // namespace

struct ShadeGrids::Grids {
    /// A grid; its leaves, and where they are, by the number of a brick; and the bricks that changed since it was made.
    struct Version {
        std::shared_ptr<FieldGrid> field;
        std::vector<ShadeLeaf> leaves;
        std::vector<glm::ivec3> places;
        std::vector<std::uint32_t> changed;
        std::vector<std::uint8_t> marks;

        void note(const ShadeBricks& bricks);
        void forget_changes();
        Version copy() const;
        void remove_stale(const ShadeBricks& bricks);
        void add_new(const ShadeBricks& bricks);
        bool is_read(long holders) const {
            return is_held_by_others(field, holders) || is_held_by_others(field->grid, 1);
        }

    private:
        void place_leaf(std::size_t number, Leaf& leaf);
    };

    /// A field as it is, and as it was when it was last read.
    struct One {
        Version now;
        std::vector<Version> before;
        int idle = 0;  ///< steps in which nobody asked for it

        void note(const ShadeBricks& bricks);
        bool prepare(const ShadeBricks& bricks, const VoxelBox& shown);
        void forget(const ShadeBricks& bricks);
        template <class Write>
        void bring_up_to_date(const ShadeBricks& bricks, const VoxelBox& shown, const Write& write);

    private:
        void require_own();
        std::size_t most_before() const;
    };
    One light, shade;
};

void ShadeGrids::Grids::Version::note(const ShadeBricks& bricks) {
    marks.resize(bricks.end(), 0);
    for (const std::uint32_t number : bricks.changed()) {
        if (marks[number]) continue;
        marks[number] = 1;
        changed.push_back(number);
    }
}

void ShadeGrids::Grids::Version::forget_changes() {
    for (const std::uint32_t number : changed) marks[number] = 0;
    changed.clear();
}

void ShadeGrids::Grids::Version::place_leaf(std::size_t number, Leaf& leaf) {
    leaves[number] = {leaf.buffer().data(), &leaf.getValueMask().getWord<openvdb::Index64>(0)};
}

ShadeGrids::Grids::Version ShadeGrids::Grids::Version::copy() const {
    Version made = *this;
    const openvdb::FloatGrid::Ptr grid = field->grid->deepCopy();
    grid->setTransform(field->grid->transformPtr());  // a copied one is written in other bytes
    made.field = std::make_shared<FieldGrid>(FieldGrid{grid, field->box, true});
    openvdb::FloatGrid::Accessor tree = grid->getAccessor();
    for (std::size_t number = 0; number < leaves.size(); ++number) {
        if (leaves[number].values != nullptr) made.place_leaf(number, *tree.probeLeaf(origin_of(places[number])));
    }
    return made;
}

void ShadeGrids::Grids::One::note(const ShadeBricks& bricks) {
    now.note(bricks);
    for (Version& version : before) version.note(bricks);
}

/// So many versions are kept, read or not, as take little memory.
std::size_t ShadeGrids::Grids::One::most_before() const {
    constexpr std::size_t most_bytes = std::size_t{64} << 20, most = 6;
    return std::min(most, most_bytes / (now.leaves.size() * sizeof(Leaf) + 1));
}

// With more holders than the field and ourselves, someone reads the grid of a step before: it is left to them. One that
// they have read serves again, which is cheaper than a copy.
void ShadeGrids::Grids::One::require_own() {
    if (now.is_read(2)) {
        const auto free = std::find_if(before.begin(), before.end(), [](const Version& v) { return !v.is_read(1); });
        if (free != before.end()) {
            std::swap(now, *free);
        } else {
            Version made = now.copy();
            std::swap(now, made);
            if (before.size() < most_before()) before.push_back(std::move(made));
        }
    }
}

void ShadeGrids::Grids::Version::remove_stale(const ShadeBricks& bricks) {
    leaves.resize(bricks.end());
    places.resize(bricks.end());
    for (const std::uint32_t number : changed) {
        if (leaves[number].values == nullptr) continue;
        if (bricks.exists(number) && places[number] == bricks.brick(number)) continue;
        remove_leaf(field->grid->tree(), origin_of(places[number]));
        leaves[number] = {};
    }
}

void ShadeGrids::Grids::Version::add_new(const ShadeBricks& bricks) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t number : changed) {
        if (bricks.exists(number) && leaves[number].values == nullptr) numbers.push_back(number);
    }
    const float background = field->grid->background();
    std::vector<std::unique_ptr<Leaf>> fresh(numbers.size());
    for_in_parallel(std::size_t{0}, numbers.size(), [&](std::size_t i) {
        places[numbers[i]] = bricks.brick(numbers[i]);
        fresh[i] = std::make_unique<Leaf>(origin_of(places[numbers[i]]), background);
        place_leaf(numbers[i], *fresh[i]);
    });
    openvdb::FloatGrid::Accessor tree = field->grid->getAccessor();
    for (std::unique_ptr<Leaf>& leaf : fresh) tree.addLeaf(leaf.release());
}

// Leaves that stay are written over. False if nothing has changed.
bool ShadeGrids::Grids::One::prepare(const ShadeBricks& bricks, const VoxelBox& shown) {
    // A viewer of an empty field still needs something to show: the voxel at the origin.
    const VoxelBox box = shown.empty() ? VoxelBox{glm::ivec3(0), glm::ivec3(0)} : shown;
    const openvdb::CoordBBox shown_box(coord(box.lower), coord(box.upper));
    if (now.changed.empty() && now.field->box == shown_box) return false;
    require_own();
    now.field->box = shown_box;
    now.remove_stale(bricks);
    now.add_new(bricks);
    return true;
}

// The field stays the same for those who know it, and is empty until it is asked for again.
void ShadeGrids::Grids::One::forget(const ShadeBricks& bricks) {
    if (now.leaves.empty() || now.is_read(2)) return;
    now.field->grid->tree().clear();
    now.leaves = {};
    now.places = {};
    before.clear();
    now.forget_changes();
    now.marks.resize(bricks.end(), 0);
    for (std::size_t number = 0; number < bricks.end(); ++number) {
        if (!bricks.exists(number)) continue;
        now.marks[number] = 1;
        now.changed.push_back(static_cast<std::uint32_t>(number));
    }
}

template <class Write>
void ShadeGrids::Grids::One::bring_up_to_date(const ShadeBricks& bricks, const VoxelBox& shown, const Write& write) {
    if (!prepare(bricks, shown)) return;
    for_in_parallel(std::size_t{0}, now.changed.size(), [&](std::size_t i) {
        const std::uint32_t number = now.changed[i];
        if (bricks.exists(number)) write(bricks.sums(number), now.leaves[number]);
    });
    now.forget_changes();
}

ShadeGrids::ShadeGrids(std::string name, const ShadeRule& rule, const ShadeLattice& lattice)
    : name_(std::move(name)), rule_(rule), grids_(std::make_unique<Grids>()) {
    initialize_openvdb();
    const auto make = [&](const std::string& field, double background) {
        const auto grid = openvdb::FloatGrid::create(static_cast<float>(background));
        grid->setTransform(cell_centred_transform(lattice.voxel, lattice.centre - 0.5 * lattice.voxel));
        grid->setName(field);
        return std::make_shared<FieldGrid>(FieldGrid{grid, {}, true});
    };
    grids_->light.now.field = make(name_, light_under(rule, 0));
    grids_->shade.now.field = make(name_ + ".shade", 0);
}

ShadeGrids::~ShadeGrids() = default;

void ShadeGrids::provide(ShadeBricks& bricks, const VoxelBox& shown, Fields& fields) {
    const auto light = [this, &bricks, &shown]() -> std::shared_ptr<const FieldGrid> {
        note_changes(bricks);
        light_asked_for_ = true;
        grids_->light.idle = 0;
        const auto write = [this](const Shade* sums, const ShadeLeaf& leaf) { write_light(rule_, sums, leaf); };
        grids_->light.bring_up_to_date(bricks, shown, write);
        return grids_->light.now.field;
    };
    const auto shade = [this, &bricks, &shown]() -> std::shared_ptr<const FieldGrid> {
        note_changes(bricks);
        grids_->shade.idle = 0;
        grids_->shade.bring_up_to_date(bricks, shown, write_shade);
        return grids_->shade.now.field;
    };
    fields.provide({name_, "1", "light: what full light the shadows leave", light(), true, light});
    fields.provide({name_ + ".shade", "1", rule_.attenuate ? "optical depth of all shadows" : "sum of all shadows",
                    shade(), true, shade});
    light_asked_for_ = false;
}

void ShadeGrids::begin_step(const ShadeBricks& bricks) {
    constexpr int long_idle = 8;
    for (Grids::One* one : {&grids_->light, &grids_->shade}) {
        if (++one->idle >= long_idle) one->forget(bricks);
    }
}

std::span<const ShadeLeaf> ShadeGrids::light_to_write(ShadeBricks& bricks, const VoxelBox& shown) {
    if (!light_asked_for_) return {};
    light_asked_for_ = false;
    note_changes(bricks);
    grids_->light.prepare(bricks, shown);
    grids_->light.now.forget_changes();
    return grids_->light.now.leaves;
}

void ShadeGrids::note_changes(ShadeBricks& bricks) {
    if (bricks.changed().empty()) return;
    grids_->light.note(bricks);
    grids_->shade.note(bricks);
    bricks.forget_changes();
}

}  // namespace espalier::environment
