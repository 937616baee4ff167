#include "geometry/grids/grid_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/geometry/openvdb_grid.h"

#include "geometry/grids/active_values.h"
#include "geometry/grids/vdb_file.h"
#include "geometry/grids/written_grid.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>

#include <sstream>
#include <string_view>

namespace espalier::geometry {
namespace {

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
