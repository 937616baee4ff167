// A small grid of floats for pages, which stands where OpenVDB stands on a machine: blocks of 8 x 8 x 8 voxels in a
// hash table, and boxes of one value. It has the names and the arithmetic of what Espalier calls of OpenVDB (Museth
// 2013), so that the same sources serve both, and answers with the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace openvdb {

using Index = std::uint32_t;
using Index64 = std::uint64_t;

// --- places ---------------------------------------------------------------------------------------------------------

struct Vec3d {
    std::array<double, 3> parts{};

    Vec3d() = default;
    explicit Vec3d(double all) : parts{all, all, all} {}
    Vec3d(double x, double y, double z) : parts{x, y, z} {}

    double x() const { return parts[0]; }
    double y() const { return parts[1]; }
    double z() const { return parts[2]; }
    double& operator[](int axis) { return parts[static_cast<std::size_t>(axis)]; }
    double operator[](int axis) const { return parts[static_cast<std::size_t>(axis)]; }
    bool operator==(const Vec3d&) const = default;

    Vec3d& operator+=(const Vec3d& other) {
        return each(other, [](double a, double b) { return a + b; });
    }
    Vec3d& operator-=(const Vec3d& other) {
        return each(other, [](double a, double b) { return a - b; });
    }
    Vec3d& operator*=(const Vec3d& other) {
        return each(other, [](double a, double b) { return a * b; });
    }
    Vec3d& operator/=(double by) {
        return each(Vec3d(by), [](double a, double b) { return a / b; });
    }
    friend Vec3d operator+(Vec3d a, const Vec3d& b) { return a += b; }
    friend Vec3d operator-(Vec3d a, const Vec3d& b) { return a -= b; }
    friend Vec3d operator*(Vec3d a, const Vec3d& b) { return a *= b; }
    friend Vec3d operator*(double a, const Vec3d& b) { return Vec3d(a) *= b; }

private:
    template <class Operation>
    Vec3d& each(const Vec3d& other, const Operation& operation) {
        for (int axis = 0; axis < 3; ++axis) (*this)[axis] = operation((*this)[axis], other[axis]);
        return *this;
    }
};

class Coord {
public:
    Coord() = default;
    explicit Coord(std::int32_t all) : parts_{all, all, all} {}
    Coord(std::int32_t x, std::int32_t y, std::int32_t z) : parts_{x, y, z} {}

    static Coord floor(const Vec3d& at) {
        return of(at, [](double part) { return std::floor(part); });
    }
    static Coord round(const Vec3d& at) {
        return of(at, [](double part) { return std::floor(part + 0.5); });
    }

    std::int32_t x() const { return parts_[0]; }
    std::int32_t y() const { return parts_[1]; }
    std::int32_t z() const { return parts_[2]; }
    std::int32_t& x() { return parts_[0]; }
    std::int32_t& y() { return parts_[1]; }
    std::int32_t& z() { return parts_[2]; }
    std::int32_t& operator[](int axis) { return parts_[static_cast<std::size_t>(axis)]; }
    std::int32_t operator[](int axis) const { return parts_[static_cast<std::size_t>(axis)]; }
    bool operator==(const Coord&) const = default;
    bool operator<(const Coord& other) const { return parts_ < other.parts_; }

    friend Coord operator+(const Coord& a, const Coord& b) { return {a.x() + b.x(), a.y() + b.y(), a.z() + b.z()}; }
    friend Coord operator-(const Coord& a, const Coord& b) { return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()}; }
    Coord offsetBy(std::int32_t all) const { return *this + Coord(all); }
    Coord offsetBy(std::int32_t x, std::int32_t y, std::int32_t z) const { return *this + Coord(x, y, z); }
    Vec3d asVec3d() const { return {double(x()), double(y()), double(z())}; }
    /// The lower corner of the block of 2^bits voxels an edge.
    Coord block(int bits) const {
        const std::int32_t kept = ~((std::int32_t{1} << bits) - 1);
        return {x() & kept, y() & kept, z() & kept};
    }

private:
    template <class Whole>
    static Coord of(const Vec3d& at, const Whole& whole) {
        return {static_cast<std::int32_t>(whole(at.x())), static_cast<std::int32_t>(whole(at.y())),
                static_cast<std::int32_t>(whole(at.z()))};
    }

    std::array<std::int32_t, 3> parts_{};
};

struct CoordHash {
    std::size_t operator()(const Coord& at) const {
        const auto part = [&](int axis) { return static_cast<std::uint32_t>(at[axis]); };
        const std::uint32_t mixed = part(0) * 0x9E3779B1u ^ part(1) * 0x85EBCA77u ^ part(2) * 0xC2B2AE3Du;
        return mixed ^ mixed >> 15;
    }
};

class CoordBBox {
public:
    /// Empty.
    CoordBBox() { reset(); }
    CoordBBox(const Coord& least, const Coord& most) : least_(least), most_(most) {}

    void reset() {
        least_ = Coord(std::numeric_limits<std::int32_t>::max());
        most_ = Coord(std::numeric_limits<std::int32_t>::min());
    }
    const Coord& min() const { return least_; }
    const Coord& max() const { return most_; }
    bool operator==(const CoordBBox&) const = default;
    bool empty() const { return least_.x() > most_.x() || least_.y() > most_.y() || least_.z() > most_.z(); }
    Coord dim() const { return empty() ? Coord(0) : (most_ - least_).offsetBy(1); }
    Index64 volume() const {
        const Coord size = dim();
        return Index64(size.x()) * Index64(size.y()) * Index64(size.z());
    }
    /// The axis that it is longest along.
    int maxExtent() const {
        const Coord size = dim();
        int longest = 0;
        for (int axis = 1; axis < 3; ++axis) longest = size[axis] >= size[longest] ? axis : longest;
        return longest;
    }
    bool isInside(const Coord& at) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (at[axis] < least_[axis] || at[axis] > most_[axis]) return false;
        }
        return true;
    }
    bool hasOverlap(const CoordBBox& other) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (most_[axis] < other.least_[axis] || least_[axis] > other.most_[axis]) return false;
        }
        return true;
    }
    void expand(const Coord& at) { expand(CoordBBox(at, at)); }
    void expand(const CoordBBox& other) {
        for (int axis = 0; axis < 3; ++axis) {
            least_[axis] = std::min(least_[axis], other.least_[axis]);
            most_[axis] = std::max(most_[axis], other.most_[axis]);
        }
    }
    CoordBBox expandBy(std::int32_t voxels) const { return {least_.offsetBy(-voxels), most_.offsetBy(voxels)}; }
    void intersect(const CoordBBox& other) {
        for (int axis = 0; axis < 3; ++axis) {
            least_[axis] = std::max(least_[axis], other.least_[axis]);
            most_[axis] = std::min(most_[axis], other.most_[axis]);
        }
    }

private:
    Coord least_, most_;
};

namespace math {

/// Voxels of one edge, shifted.
class Transform {
public:
    using Ptr = std::shared_ptr<Transform>;

    static Ptr createLinearTransform(double voxel) { return std::make_shared<Transform>(voxel); }
    explicit Transform(double voxel) : voxel_(voxel), per_voxel_(1 / voxel) {}

    Ptr copy() const { return std::make_shared<Transform>(*this); }
    void postTranslate(const Vec3d& shift) { shift_ += shift; }
    bool isLinear() const { return true; }
    bool operator==(const Transform&) const = default;
    Vec3d voxelSize() const { return Vec3d(voxel_); }
    const Vec3d& shift() const { return shift_; }
    Vec3d worldToIndex(const Vec3d& at) const { return (at - shift_) * Vec3d(per_voxel_); }
    Vec3d indexToWorld(const Vec3d& at) const { return at * Vec3d(voxel_) + shift_; }
    Vec3d indexToWorld(const Coord& at) const { return indexToWorld(at.asVec3d()); }

private:
    double voxel_, per_voxel_;
    Vec3d shift_;
};

}  // namespace math

// --- blocks ---------------------------------------------------------------------------------------------------------

/// Which of a block's voxels are set.
class BlockMask {
public:
    bool isOn(Index voxel) const { return words_[voxel >> 6] >> (voxel & 63) & 1; }
    void setOn(Index voxel) { words_[voxel >> 6] |= Index64{1} << (voxel & 63); }
    void setOff(Index voxel) { words_[voxel >> 6] &= ~(Index64{1} << (voxel & 63)); }
    bool isOff() const { return *this == BlockMask(); }
    bool operator==(const BlockMask&) const = default;
    template <class Word>
    const Word& getWord(Index number) const {
        return words_[number];
    }
    template <class Word>
    Word& getWord(Index number) {
        return words_[number];
    }

private:
    std::array<Index64, 8> words_{};
};

class FloatLeaf {
public:
    static constexpr int DIM = 8, LOG2DIM = 3;
    static constexpr Index SIZE = 512;

    struct Buffer {
        std::array<float, SIZE> values;
        float* data() { return values.data(); }
        const float* data() const { return values.data(); }
        bool operator==(const Buffer&) const = default;
    };

    FloatLeaf(const Coord& at, float value, bool active = false) : origin_(at.block(LOG2DIM)) {
        buffer_.values.fill(value);
        if (!active) return;
        for (Index voxel = 0; voxel < SIZE; ++voxel) mask_.setOn(voxel);
    }

    static Index coordToOffset(const Coord& at) {
        constexpr std::int32_t within = DIM - 1;
        return static_cast<Index>((at.x() & within) << 6 | (at.y() & within) << 3 | (at.z() & within));
    }
    Coord offsetToGlobalCoord(Index voxel) const {
        return origin_.offsetBy(int(voxel >> 6), int(voxel >> 3 & 7), int(voxel & 7));
    }
    const Coord& origin() const { return origin_; }
    CoordBBox getNodeBoundingBox() const { return {origin_, origin_.offsetBy(DIM - 1)}; }
    Buffer& buffer() { return buffer_; }
    const Buffer& buffer() const { return buffer_; }
    BlockMask& getValueMask() { return mask_; }
    const BlockMask& getValueMask() const { return mask_; }
    void setValueOn(Index voxel) { mask_.setOn(voxel); }
    void setValueOn(Index voxel, float value) {
        buffer_.values[voxel] = value;
        mask_.setOn(voxel);
    }
    void setValueOff(Index voxel) { mask_.setOff(voxel); }
    void setValueOff(Index voxel, float value) {
        buffer_.values[voxel] = value;
        mask_.setOff(voxel);
    }
    bool operator==(const FloatLeaf&) const = default;

private:
    Coord origin_;
    Buffer buffer_;
    BlockMask mask_;
};

/// A box of 2^k voxels an edge with one value, k from 3 on.
struct FloatTile {
    float value = 0;
    bool active = false;
    bool operator==(const FloatTile&) const = default;
};

class FloatTree {
public:
    using ValueType = float;
    using LeafNodeType = FloatLeaf;
    // What lies between the root and the leaves of OpenVDB's trees has no counterpart here.
    struct LowerNode {
        const BlockMask& getChildMask() const { return children; }
        BlockMask children;
    };
    struct UpperNode : LowerNode {
        using ChildNodeType = LowerNode;
    };
    struct RootNodeType {
        using ChildNodeType = UpperNode;
        void eraseBackgroundTiles() {}
    };

    explicit FloatTree(float background) : background_(background) {}
    FloatTree(const FloatTree& other) : background_(other.background_), tiles_(other.tiles_) {
        leaves_.reserve(other.leaves_.size());
        for (const auto& [at, leaf] : other.leaves_) leaves_.emplace(at, std::make_unique<FloatLeaf>(*leaf));
    }
    FloatTree& operator=(const FloatTree&) = delete;

    float background() const { return background_; }
    Index64 leafCount() const { return leaves_.size(); }
    std::size_t memUsage() const { return leaves_.size() * (sizeof(FloatLeaf) + 64) + sizeof *this; }
    void clear() {
        leaves_.clear();
        tiles_.clear();
    }

    float getValue(const Coord& at) const {
        float value = 0;
        probeValue(at, value);
        return value;
    }
    /// Whether the voxel is set; its value in any case.
    bool probeValue(const Coord& at, float& value) const {
        const FloatLeaf* const leaf = probeLeaf(at);
        if (leaf) {
            const Index voxel = FloatLeaf::coordToOffset(at);
            value = leaf->buffer().values[voxel];
            return leaf->getValueMask().isOn(voxel);
        }
        const FloatTile tile = tile_at(at);
        value = tile.value;
        return tile.active;
    }
    void setValue(const Coord& at, float value) { touchLeaf(at)->setValueOn(FloatLeaf::coordToOffset(at), value); }

    FloatLeaf* probeLeaf(const Coord& at) {
        const auto found = leaves_.find(at.block(FloatLeaf::LOG2DIM));
        return found == leaves_.end() ? nullptr : found->second.get();
    }
    const FloatLeaf* probeLeaf(const Coord& at) const { return const_cast<FloatTree*>(this)->probeLeaf(at); }
    FloatLeaf* touchLeaf(const Coord& at) {
        std::unique_ptr<FloatLeaf>& leaf = leaves_[at.block(FloatLeaf::LOG2DIM)];
        if (!leaf) {
            const FloatTile tile = tile_at(at);
            leaf = std::make_unique<FloatLeaf>(at, tile.value, tile.active);
        }
        return leaf.get();
    }
    /// Takes it, instead of one that is there.
    void addLeaf(FloatLeaf* leaf) { leaves_[leaf->origin()].reset(leaf); }

    /// Of a block of 8^3 (level 1) in place of its leaf. Nodes above do not exist here.
    void addTile(Index level, const Coord& at, float value, bool active) {
        if (level != 1) return;
        const Coord block = at.block(FloatLeaf::LOG2DIM);
        leaves_.erase(block);
        set_tile(FloatLeaf::LOG2DIM, block, {value, active});
    }
    template <class Node>
    const Node* probeConstNode(const Coord&) const {
        return nullptr;
    }
    RootNodeType& root() { return root_; }

    /// All voxels of a box that is a block of 2^k voxels an edge, k from 3 on; leaves in it stay as they are.
    void fill(const CoordBBox& box, float value, bool active) {
        const int bits = std::bit_width(static_cast<std::uint32_t>(box.dim().x())) - 1;
        set_tile(bits, box.min(), {value, active});
    }
    /// Makes a leaf of each block that the box meets, with the box's voxels set so.
    void denseFill(const CoordBBox& box, float value, bool active) {
        const Coord first = box.min().block(FloatLeaf::LOG2DIM);
        for (int x = first.x(); x <= box.max().x(); x += FloatLeaf::DIM) {
            for (int y = first.y(); y <= box.max().y(); y += FloatLeaf::DIM) {
                for (int z = first.z(); z <= box.max().z(); z += FloatLeaf::DIM) {
                    fill_leaf(*touchLeaf({x, y, z}), box, value, active);
                }
            }
        }
    }

    /// Blocks in no particular order.
    class LeafIterator {
    public:
        using Blocks = std::unordered_map<Coord, std::unique_ptr<FloatLeaf>, CoordHash>;

        LeafIterator(const Blocks& blocks) : at_(blocks.begin()), end_(blocks.end()) {}
        explicit operator bool() const { return at_ != end_; }
        LeafIterator& operator++() {
            ++at_;
            return *this;
        }
        const FloatLeaf& operator*() const { return *at_->second; }
        const FloatLeaf* operator->() const { return at_->second.get(); }

    private:
        Blocks::const_iterator at_, end_;
    };
    LeafIterator cbeginLeaf() const { return leaves_; }
    /// Their places in order, so that what is written of a tree depends on its content alone.
    std::vector<Coord> leaf_places() const {
        std::vector<Coord> places;
        places.reserve(leaves_.size());
        for (const auto& [at, leaf] : leaves_) places.push_back(at);
        std::sort(places.begin(), places.end());
        return places;
    }

    using Tiles = std::unordered_map<Coord, FloatTile, CoordHash>;
    using TilesOfEdge = std::pair<int, Tiles>;  ///< boxes of 2^first voxels an edge
    const std::vector<TilesOfEdge>& tiles() const { return tiles_; }
    void set_tile(int bits, const Coord& at, const FloatTile& tile) {
        const auto same_edge = [&](const TilesOfEdge& tiles) { return tiles.first == bits; };
        auto of_edge = std::find_if(tiles_.begin(), tiles_.end(), same_edge);
        const bool is_plain = tile == FloatTile{background_, false};
        if (of_edge == tiles_.end()) {
            if (is_plain) return;
            of_edge = tiles_.insert(tiles_.end(), {bits, {}});
        }
        if (is_plain) {
            of_edge->second.erase(at);
        } else {
            of_edge->second[at] = tile;
        }
    }

private:
    FloatTile tile_at(const Coord& at) const {
        for (const auto& [bits, tiles] : tiles_) {
            const auto found = tiles.find(at.block(bits));
            if (found != tiles.end()) return found->second;
        }
        return {background_, false};
    }
    static void fill_leaf(FloatLeaf& leaf, const CoordBBox& box, float value, bool active) {
        CoordBBox part = leaf.getNodeBoundingBox();
        part.intersect(box);
        for (int x = part.min().x(); x <= part.max().x(); ++x) {
            for (int y = part.min().y(); y <= part.max().y(); ++y) {
                for (int z = part.min().z(); z <= part.max().z(); ++z) {
                    const Index voxel = FloatLeaf::coordToOffset({x, y, z});
                    active ? leaf.setValueOn(voxel, value) : leaf.setValueOff(voxel, value);
                }
            }
        }
    }

    float background_;
    LeafIterator::Blocks leaves_;
    std::vector<TilesOfEdge> tiles_;
    RootNodeType root_;
};

/// Looks first in the block where it looked last.
template <class Tree>
class BlockAccessor {
public:
    explicit BlockAccessor(Tree& tree) : tree_(&tree) {}

    float getValue(const Coord& at) const {
        const FloatLeaf* const leaf = find(at);
        return leaf ? leaf->buffer().values[FloatLeaf::coordToOffset(at)] : tree_->getValue(at);
    }
    void setValue(const Coord& at, float value) { touchLeaf(at)->setValueOn(FloatLeaf::coordToOffset(at), value); }
    FloatLeaf* touchLeaf(const Coord& at) {
        if (!find(at)) last_ = tree_->touchLeaf(at);
        return last_;
    }
    FloatLeaf* probeLeaf(const Coord& at) { return find(at); }
    void addLeaf(FloatLeaf* leaf) {
        last_ = leaf;
        tree_->addLeaf(leaf);
    }

private:
    FloatLeaf* find(const Coord& at) const {
        if (!last_ || last_->origin() != at.block(FloatLeaf::LOG2DIM)) {
            last_ = const_cast<FloatLeaf*>(std::as_const(*tree_).probeLeaf(at));
        }
        return last_;
    }

    Tree* tree_;
    mutable FloatLeaf* last_ = nullptr;
};

// --- grids ----------------------------------------------------------------------------------------------------------

enum GridClass { GRID_UNKNOWN, GRID_LEVEL_SET };

class FloatGrid {
public:
    using Ptr = std::shared_ptr<FloatGrid>;
    using ConstPtr = std::shared_ptr<const FloatGrid>;
    using TreeType = FloatTree;
    using Accessor = BlockAccessor<FloatTree>;
    using ConstAccessor = BlockAccessor<const FloatTree>;

    explicit FloatGrid(float background) : tree_(background) {}

    static Ptr create(float background = 0) { return std::make_shared<FloatGrid>(background); }
    /// With a transform of its own.
    Ptr deepCopy() const {
        auto copy = std::make_shared<FloatGrid>(*this);
        copy->transform_ = transform_->copy();
        return copy;
    }

    FloatTree& tree() { return tree_; }
    const FloatTree& tree() const { return tree_; }
    float background() const { return tree_.background(); }
    std::size_t memUsage() const { return tree_.memUsage(); }
    void clear() { tree_.clear(); }
    Accessor getAccessor() { return Accessor(tree_); }
    ConstAccessor getConstAccessor() const { return ConstAccessor(tree_); }

    void setTransform(math::Transform::Ptr transform) { transform_ = std::move(transform); }
    math::Transform::Ptr transformPtr() const { return transform_; }
    const math::Transform& transform() const { return *transform_; }
    Vec3d worldToIndex(const Vec3d& at) const { return transform_->worldToIndex(at); }
    Vec3d indexToWorld(const Vec3d& at) const { return transform_->indexToWorld(at); }
    Vec3d indexToWorld(const Coord& at) const { return transform_->indexToWorld(at); }
    Vec3d voxelSize() const { return transform_->voxelSize(); }

    void setName(const std::string& name) { name_ = name; }
    const std::string& getName() const { return name_; }
    void setGridClass(GridClass) {}

    bool only_active_values = false;  ///< values between voxels are those of set ones alone

private:
    FloatTree tree_;
    math::Transform::Ptr transform_ = math::Transform::createLinearTransform(1);
    std::string name_;
};

}  // namespace openvdb
