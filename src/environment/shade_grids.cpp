#include "environment/shade_grids.h"

#include "espalier/base/vector_clones.h"
#include "espalier/environment/openvdb_grid.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstring>

namespace espalier {
namespace {

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
static_assert(Leaf::DIM == ShadeBricks::edge && Leaf::SIZE == ShadeBricks::voxels);

openvdb::Coord coord(const glm::ivec3& voxel) {
    return {voxel.x, voxel.y, voxel.z};
}

// Whole numbers below 2^52 as the bits of a double above 2^52: every width of vectors can do that.
constexpr std::uint64_t exponent_52 = 0x4330000000000000;
constexpr double two_52 = 4503599627370496.0;

/// Which of a brick's voxels are shaded, 64 to a word, and whether all of them are below 2^52.
ESPALIER_VECTOR_CLONES
bool find_shaded(const Shade* sums, std::uint64_t* words) {
    std::uint64_t all = 0;
    for (std::size_t word = 0; word < ShadeBricks::voxels / 64; ++word) {
        std::uint64_t bits = 0;
        for (std::size_t bit = 0; bit < 64; ++bit) {
            const auto sum = static_cast<std::uint64_t>(sums[64 * word + bit]);
            all |= sum;
            bits |= ((0 - sum) >> 63) << bit;  // sums are not negative
        }
        words[word] = bits;
    }
    return all < std::uint64_t(1) << 52;
}

// In as many parts as the machine's vectors need.
using WholeEight = std::uint64_t __attribute__((vector_size(64)));
using RealEight = double __attribute__((vector_size(64)));
using FloatEight = float __attribute__((vector_size(32)));

ESPALIER_VECTOR_CLONES
void write_added(const Shade* sums, double full_light, float* light, float* shade) {
    for (std::size_t i = 0; i < ShadeBricks::voxels; i += 8) {
        WholeEight bits;
        std::memcpy(&bits, sums + i, sizeof bits);
        bits |= exponent_52;
        RealEight amount;
        std::memcpy(&amount, &bits, sizeof bits);
        amount = (amount - two_52) * (1 / shade_steps_per_unit);
        RealEight left = full_light - amount;
        left = left < 0.0 ? RealEight{} : left;
        const FloatEight shades = __builtin_convertvector(amount, FloatEight);
        const FloatEight lights = __builtin_convertvector(left, FloatEight);
        std::memcpy(shade + i, &shades, sizeof shades);
        std::memcpy(light + i, &lights, sizeof lights);
    }
}

void write(const ShadeRule& rule, const Shade* sums, Leaf& light, Leaf& shade) {
    Leaf::NodeMaskType shaded;
    std::uint64_t words[Leaf::NodeMaskType::WORD_COUNT];
    const bool small = find_shaded(sums, words);
    for (openvdb::Index word = 0; word < Leaf::NodeMaskType::WORD_COUNT; ++word) {
        shaded.getWord<openvdb::Index64>(word) = words[word];
    }
    light.setValueMask(shaded);
    shade.setValueMask(shaded);
    float *light_values = light.buffer().data(), *shade_values = shade.buffer().data();
    if (small && !rule.attenuate) return write_added(sums, rule.full_light, light_values, shade_values);
    for (std::size_t i = 0; i < ShadeBricks::voxels; ++i) {
        shade_values[i] = static_cast<float>(shade_value(sums[i]));
        light_values[i] = static_cast<float>(light_under(rule, sums[i]));
    }
}

/// Removes a leaf and what of the nodes above it has become empty: a tree made anew would not have them either.
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
    /// A grid and, by the number of a brick, its leaves.
    struct One {
        std::shared_ptr<FieldGrid> field;
        std::vector<Leaf*> leaves;

        void require_own();
        void remove_stale(const ShadeBricks& bricks);
        void add_new(const ShadeBricks& bricks);
    };
    One light, shade;
};

// With more holders than the field and ourselves, someone reads the grid of a step before: it is left to them.
void ShadeGrids::Grids::One::require_own() {
    if (field.use_count() <= 2 && field->grid.use_count() == 1) {
        std::atomic_thread_fence(std::memory_order_acquire);  // what the last reader read comes before what we write
        return;
    }
    const openvdb::FloatGrid::Ptr copy = field->grid->deepCopy();
    copy->setTransform(field->grid->transformPtr());  // a copied one is written in other bytes
    field = std::make_shared<FieldGrid>(FieldGrid{copy, field->box});
    for (Leaf*& leaf : leaves) {
        if (leaf != nullptr) leaf = field->grid->tree().probeLeaf(leaf->origin());
    }
}

void ShadeGrids::Grids::One::remove_stale(const ShadeBricks& bricks) {
    leaves.resize(bricks.end(), nullptr);
    for (const std::uint32_t number : bricks.changed()) {
        Leaf*& leaf = leaves[number];
        if (leaf == nullptr) continue;
        const openvdb::Coord origin = leaf->origin();
        if (bricks.exists(number) && origin == coord(bricks.brick(number) * ShadeBricks::edge)) continue;
        remove_leaf(field->grid->tree(), origin);
        leaf = nullptr;
    }
}

void ShadeGrids::Grids::One::add_new(const ShadeBricks& bricks) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t number : bricks.changed()) {
        if (bricks.exists(number) && leaves[number] == nullptr) numbers.push_back(number);
    }
    const float background = field->grid->background();
    tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t i) {
        leaves[numbers[i]] = new Leaf(coord(bricks.brick(numbers[i]) * ShadeBricks::edge), background);
    });
    openvdb::FloatGrid::Accessor tree = field->grid->getAccessor();
    for (const std::uint32_t number : numbers) tree.addLeaf(leaves[number]);
}

ShadeGrids::ShadeGrids(std::string name, const ShadeRule& rule, double voxel)
    : name_(std::move(name)), rule_(rule), grids_(std::make_unique<Grids>()) {
    initialize_openvdb();
    const auto make = [&](const std::string& field, double background) {
        const auto grid = openvdb::FloatGrid::create(static_cast<float>(background));
        grid->setTransform(cell_centred_transform(voxel, glm::dvec3(-0.5 * voxel)));
        grid->setName(field);
        return std::make_shared<FieldGrid>(FieldGrid{grid, {}});
    };
    grids_->light.field = make(name_, light_under(rule, 0));
    grids_->shade.field = make(name_ + ".shade", 0);
}

ShadeGrids::~ShadeGrids() = default;

void ShadeGrids::provide(ShadeBricks& bricks, const VoxelBox& shown, Fields& fields) {
    const auto current = [this, &bricks, &shown](Grids::One Grids::*which) {
        bring_up_to_date(bricks, shown);
        return std::shared_ptr<const FieldGrid>(((*grids_).*which).field);
    };
    fields.provide({name_, "1", "light: what full light the shadows leave", current(&Grids::light), true,
                    [current] { return current(&Grids::light); }});
    fields.provide({name_ + ".shade", "1", rule_.attenuate ? "optical depth of all shadows" : "sum of all shadows",
                    current(&Grids::shade), true, [current] { return current(&Grids::shade); }});
}

// Leaves that stay are written over.
void ShadeGrids::bring_up_to_date(ShadeBricks& bricks, const VoxelBox& shown) {
    // A viewer of an empty field still needs something to show: the voxel at the origin.
    const VoxelBox box = shown.empty() ? VoxelBox{glm::ivec3(0), glm::ivec3(0)} : shown;
    const openvdb::CoordBBox shown_box(coord(box.lower), coord(box.upper));
    Grids::One &light = grids_->light, &shade = grids_->shade;
    if (bricks.changed().empty() && light.field->box == shown_box) return;
    for (Grids::One* one : {&light, &shade}) {
        one->require_own();
        one->field->box = shown_box;
        one->remove_stale(bricks);
        one->add_new(bricks);
    }
    const std::span<const std::uint32_t> changed = bricks.changed();
    tbb::parallel_for(std::size_t{0}, changed.size(), [&](std::size_t i) {
        const std::uint32_t number = changed[i];
        if (bricks.exists(number)) write(rule_, bricks.sums(number), *light.leaves[number], *shade.leaves[number]);
    });
    bricks.forget_changes();
}

}  // namespace espalier
