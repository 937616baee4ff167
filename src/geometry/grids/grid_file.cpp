#include "geometry/grids/grid_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/geometry/openvdb_grid.h"

#include "geometry/grids/active_values.h"
#include "geometry/grids/vdb_file.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/Compression.h>

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

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

/// The field's grid with this metadata, for an archive that writes active values only, by Blosc or as they are, as
/// `compression` says. OpenVDB copies and sorts out all 32,768
/// values of every node; where FieldGrid says that they are the background's, that is written at once. The bytes are
/// the same.
openvdb::GridBase::ConstPtr written_grid(const FieldGrid& field, const openvdb::MetaMap& metadata,
                                         std::uint32_t compression) {
    if (!field.only_leaves || field.grid->saveFloatAsHalf()) return field.grid->copyGridReplacingMetadata(metadata);
    return std::make_shared<LeavesOnly>(*field.grid, metadata, compression);
}

// OpenVDB gives every file a new random UUID; this one replaces it, so that equal fields give equal bytes.
constexpr std::string_view uuid = "e5ba11e2-0000-4000-8000-000000000000";
constexpr std::size_t uuid_at = 21;  // magic number, file version, library version, flag for grid offsets

// OpenVDB's own File does not notice a full disk; this archive is written to memory.
class MemoryArchive final : public openvdb::io::Archive {
public:
    explicit MemoryArchive(std::uint32_t compression) { setCompression(compression); }

    std::string text(const openvdb::GridBase::ConstPtr& grid) const {
        std::ostringstream out(std::ios::binary);
        Archive::write(out, openvdb::GridCPtrVec{grid}, /*seekable=*/true);
        std::string bytes = std::move(out).str();
        bytes.replace(uuid_at, uuid.size(), uuid);
        return bytes;
    }
};

// Blosc compresses leaf by leaf, which takes longer than writing what there is in small fields.
std::uint32_t compression_of(const openvdb::FloatGrid& grid) {
    constexpr std::size_t worth_compressing = std::size_t{1} << 20;
    const std::size_t bytes =
        std::size_t{grid.tree().leafCount()} * openvdb::FloatTree::LeafNodeType::SIZE * sizeof(float);
    return openvdb::io::COMPRESS_ACTIVE_MASK | (bytes < worth_compressing ? 0 : openvdb::io::COMPRESS_BLOSC);
}

bool same_values(const openvdb::FloatTree& a, const openvdb::FloatTree& b) {
    auto leaf = b.cbeginLeaf();
    for (auto it = a.cbeginLeaf(); it; ++it, ++leaf) {
        if (!leaf || it->origin() != leaf->origin() || *it != *leaf) return false;
    }
    auto tile = b.cbeginValueAll();
    auto it = a.cbeginValueAll();
    constexpr int above_leaves = openvdb::FloatTree::DEPTH - 2;
    it.setMaxDepth(above_leaves);
    tile.setMaxDepth(above_leaves);
    for (; it; ++it, ++tile) {
        if (!tile || *it != *tile) return false;
    }
    return true;
}

}  // namespace

const FieldGrid& grid_of(const Field& field) {
    if (!field.grid || !field.grid->grid) {
        throw RunError(fmt::format("field '{}' has no grid to be recorded", field.name));
    }
    return *field.grid;
}

bool same_field(const FieldGrid& a, const FieldGrid& b) {
    if (&a == &b) return true;
    if (!a.grid || !b.grid || a.box != b.box || a.grid->transform() != b.grid->transform()) return false;
    return a.grid->background() == b.grid->background() && a.grid->tree().hasSameTopology(b.grid->tree()) &&
           same_values(a.grid->tree(), b.grid->tree());
}

std::string bytes_of(const FieldGrid& grid) {
    initialize_openvdb();
    const MemoryArchive archive(openvdb::io::COMPRESS_NONE);  // inactive values, too
    openvdb::MetaMap kept;
    if (has_only_active_values(*grid.grid)) kept.insertMeta(only_active_values, openvdb::BoolMetadata(true));
    return archive.text(grid.grid->copyGridReplacingMetadata(kept));
}

std::shared_ptr<const FieldGrid> grid_from_bytes(const std::string& bytes) {
    try {
        std::istringstream in(bytes, std::ios::binary);
        VdbFile file(in, memory_for_grids());
        const auto grid =
            file.names().empty() ? nullptr : openvdb::gridPtrCast<openvdb::FloatGrid>(file.read(file.names().front()));
        if (!grid) throw RunError("these bytes hold no grid");
        return std::make_shared<FieldGrid>(FieldGrid{grid, grid->evalActiveVoxelBoundingBox()});
    } catch (const VdbError& error) {
        throw RunError(fmt::format("these bytes hold no grid: {}", error.what()));
    } catch (const openvdb::Exception& error) {
        throw RunError(fmt::format("these bytes hold no grid: {}", error.what()));
    }
}

std::uint64_t digest_of(const FieldGrid& grid) {
    if (!grid.grid) return 0;
    const std::string box = fmt::format("{} {} {} {} {} {}", grid.box.min().x(), grid.box.min().y(), grid.box.min().z(),
                                        grid.box.max().x(), grid.box.max().y(), grid.box.max().z());
    return digest(box, digest(bytes_of(grid)));
}

void write_vdb(const std::filesystem::path& path, const Field& field) {
    initialize_openvdb();
    const FieldGrid& source = grid_of(field);
    openvdb::MetaMap metadata(*source.grid);
    metadata.insertMeta(openvdb::GridBase::META_GRID_NAME, openvdb::StringMetadata(field.name));
    metadata.insertMeta("unit", openvdb::StringMetadata(field.unit));
    metadata.insertMeta("meaning", openvdb::StringMetadata(field.meaning));
    const std::uint32_t compression = compression_of(*source.grid);
    const MemoryArchive archive(compression);
    std::string bytes;
    try {
        bytes = archive.text(written_grid(source, metadata, compression));
    } catch (const openvdb::Exception& error) {
        throw RunError(fmt::format("cannot write {}: {}", path.string(), error.what()));
    }
    write_text(path, bytes);
}

}  // namespace espalier::geometry
