#include "geometry/grids/written_grid.h"

#include <openvdb/io/Compression.h>

#include <memory>
#include <sstream>
#include <string>

namespace espalier::geometry {
namespace {

template <class T>
void put_value(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Node>
std::string write_values_of_empty(std::uint32_t compression) {
    const float background = 0;
    std::ostringstream out(std::ios::binary);
    openvdb::io::setDataCompression(out, compression);
    openvdb::io::setGridBackgroundValuePtr(out, &background);
    std::make_unique<Node>(openvdb::Coord(), background)->writeTopology(out);
    const std::size_t masks = 2 * Node::NUM_VALUES / 8;
    return std::move(out).str().substr(masks);
}

/// What OpenVDB writes of a node's values, all of them inactive and the background's.
template <class Node>
const std::string& values_of_empty(std::uint32_t compression) {
    using namespace openvdb::io;
    static const std::string plain = write_values_of_empty<Node>(COMPRESS_ACTIVE_MASK),
                             packed = write_values_of_empty<Node>(COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC);
    return (compression & COMPRESS_BLOSC) != 0 ? packed : plain;
}

class LeavesOnly final : public openvdb::FloatGrid {
    using Root = openvdb::FloatTree::RootNodeType;
    using Upper = Root::ChildNodeType;
    using Lower = Upper::ChildNodeType;

public:
    LeavesOnly(const openvdb::FloatGrid& grid, const openvdb::MetaMap& metadata, std::uint32_t compression)
        : openvdb::FloatGrid(const_cast<openvdb::FloatGrid&>(grid), openvdb::ShallowCopy()),  // shares the tree
          upper_values_(values_of_empty<Upper>(compression)),
          lower_values_(values_of_empty<Lower>(compression)) {
        openvdb::MetaMap::operator=(metadata);
    }

    void writeTopology(std::ostream& out) const override {
        const Root& root = tree().root();
        tree().openvdb::TreeBase::writeTopology(out);
        put_value(out, root.background());
        openvdb::io::setGridBackgroundValuePtr(out, &root.background());
        put_value(out, openvdb::Index{0});  // tiles
        put_value(out, static_cast<openvdb::Index>(root.childCount()));
        for (auto upper = root.cbeginChildOn(); upper; ++upper) {
            const openvdb::Coord origin = upper.getCoord();
            for (int axis = 0; axis < 3; ++axis) put_value(out, origin[axis]);
            put_node(out, *upper, upper_values_);
            for (auto lower = upper->cbeginChildOn(); lower; ++lower) {
                put_node(out, *lower, lower_values_);
                for (auto leaf = lower->cbeginChildOn(); leaf; ++leaf) leaf->writeTopology(out);
            }
        }
    }

private:
    template <class Node>
    static void put_node(std::ostream& out, const Node& node, const std::string& values) {
        node.getChildMask().save(out);
        node.getValueMask().save(out);
        out << values;
    }

    const std::string &upper_values_, &lower_values_;
};

}  // namespace

openvdb::GridBase::ConstPtr written_grid(const FieldGrid& field, const openvdb::MetaMap& metadata,
                                         std::uint32_t compression) {
    if (!field.only_leaves || field.grid->saveFloatAsHalf()) return field.grid->copyGridReplacingMetadata(metadata);
    return std::make_shared<LeavesOnly>(*field.grid, metadata, compression);
}

}  // namespace espalier::geometry
