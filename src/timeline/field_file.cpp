#include "timeline/field_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/base/text.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/xml_text.h"
#include "geometry/written_grid.h"
#include "timeline/vtk_file.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <sstream>
#include <string_view>

namespace espalier {
namespace {

// OpenVDB draws a new UUID for every file; this stands in its place, so that equal fields are equal bytes.
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

const FieldGrid& grid_of(const Field& field) {
    if (!field.grid || !field.grid->grid) {
        throw RunError(fmt::format("field '{}' has no grid to be recorded", field.name));
    }
    return *field.grid;
}

openvdb::CoordBBox box_of(const FieldGrid& field) {
    // Nothing active yet: one voxel, so that the file opens and has the array.
    if (field.box.empty()) return {openvdb::Coord(0), openvdb::Coord(0)};
    return field.box;
}

// Without overflow: each extent is below 2^32.
bool too_large(const openvdb::Coord& size) {
    std::uint64_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        voxels *= static_cast<std::uint32_t>(size[axis]);
        if (voxels > most_vti_voxels) return true;
    }
    return false;
}

std::string numbers(const openvdb::Vec3d& vector) {
    return fmt::format("{} {} {}", format_exact(vector.x()), format_exact(vector.y()), format_exact(vector.z()));
}

// Leaf by leaf where there is nothing else: OpenVDB looks at every node, on all threads.
Column<float> values_in(const FieldGrid& field, const openvdb::CoordBBox& box) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    Column<float> values(box.volume());
    if (!field.only_leaves) {
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
        openvdb::tools::copyToDense(*field.grid, dense);
        return values;
    }
    std::fill(values.begin(), values.end(), field.grid->background());
    const openvdb::Coord size = box.dim();
    const auto rows = static_cast<std::size_t>(size.y()), row = static_cast<std::size_t>(size.x());
    for (auto leaf = field.grid->tree().cbeginLeaf(); leaf; ++leaf) {
        openvdb::CoordBBox part = leaf->getNodeBoundingBox();
        if (!part.hasOverlap(box)) continue;
        part.intersect(box);
        const float* const of_leaf = leaf->buffer().data();
        openvdb::Coord at;
        for (at.z() = part.min().z(); at.z() <= part.max().z(); ++at.z()) {
            for (at.y() = part.min().y(); at.y() <= part.max().y(); ++at.y()) {
                at.x() = part.min().x();
                const openvdb::Coord from_corner = at - box.min();
                const auto place = [&](int axis) { return static_cast<std::size_t>(from_corner[axis]); };
                float* value = &values[(place(2) * rows + place(1)) * row + place(0)];
                for (; at.x() <= part.max().x(); ++at.x()) *value++ = of_leaf[Leaf::coordToOffset(at)];
            }
        }
    }
    return values;
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

bool same_field(const FieldGrid& a, const FieldGrid& b) {
    if (&a == &b) return true;
    if (!a.grid || !b.grid || a.box != b.box || a.grid->transform() != b.grid->transform()) return false;
    return a.grid->background() == b.grid->background() && a.grid->tree().hasSameTopology(b.grid->tree()) &&
           same_values(a.grid->tree(), b.grid->tree());
}

std::uint64_t digest_of(const FieldGrid& grid) {
    if (!grid.grid) return 0;
    const MemoryArchive archive(openvdb::io::COMPRESS_NONE);  // inactive values count, too
    const std::string bytes = archive.text(grid.grid->copyGridReplacingMetadata(openvdb::MetaMap()));
    const std::string box = fmt::format("{} {} {} {} {} {}", grid.box.min().x(), grid.box.min().y(), grid.box.min().z(),
                                        grid.box.max().x(), grid.box.max().y(), grid.box.max().z());
    return digest(bytes + box);
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

void write_vti(const std::filesystem::path& path, const Field& field, double time, int step) {
    const FieldGrid& source = grid_of(field);
    const openvdb::CoordBBox box = box_of(source);
    const openvdb::Coord size = box.dim();
    if (too_large(size)) {
        throw RunError(
            fmt::format("field '{}' spans {} x {} x {} voxels, more than the {} a .vti may hold; record it "
                        "as field_files = [\"vdb\"] only",
                        field.name, size.x(), size.y(), size.z(), most_vti_voxels));
    }
    const Column<float> values = values_in(source, box);

    const openvdb::Vec3d origin = source.grid->indexToWorld(box.min());
    const openvdb::Vec3d spacing = source.grid->voxelSize();
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", size.x() - 1, size.y() - 1, size.z() - 1);
    VtkFile file;
    file.begin("ImageData");
    file.open("ImageData", fmt::format(R"(WholeExtent="{}" Origin="{}" Spacing="{}" Direction="1 0 0 0 1 0 0 0 1")",
                                       extent, numbers(origin), numbers(spacing)));
    file.open("FieldData");
    file.add_time(time, step);
    file.add_texts("unit", {field.unit});
    file.add_texts("meaning", {field.meaning});
    file.close();
    file.open("Piece", fmt::format(R"(Extent="{}")", extent));
    file.open("PointData", fmt::format(R"(Scalars="{}")", xml_text(field.name)));
    file.add(data_array<float>(field.name, values));
    file.write(path);
}

}  // namespace espalier
