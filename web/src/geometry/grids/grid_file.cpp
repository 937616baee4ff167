// Grids compared, and kept as bytes of a form of their own: OpenVDB's files are for machines.
#include "geometry/grids/grid_file.h"

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/bytes.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace espalier::geometry {
namespace {

constexpr std::string_view mark = "ESG1";
constexpr std::uint64_t most_blocks = std::uint64_t{1} << 22;

void put_coord(std::ostream& out, const openvdb::Coord& at) {
    for (int axis = 0; axis < 3; ++axis) put(out, at[axis]);
}

openvdb::Coord get_coord(std::istream& in) {
    openvdb::Coord at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = get<std::int32_t>(in);
    return at;
}

void put_tiles(std::ostream& out, const openvdb::FloatTree& tree) {
    put(out, static_cast<std::uint64_t>(tree.tiles().size()));
    for (const auto& [bits, tiles] : tree.tiles()) {
        put(out, static_cast<std::int32_t>(bits));
        put(out, static_cast<std::uint64_t>(tiles.size()));
        std::vector<openvdb::Coord> places;
        for (const auto& [at, tile] : tiles) places.push_back(at);
        std::sort(places.begin(), places.end());
        for (const openvdb::Coord& at : places) {
            put_coord(out, at);
            put(out, tiles.at(at).value);
            put(out, tiles.at(at).active);
        }
    }
}

std::uint64_t get_count(std::istream& in) {
    const auto count = get<std::uint64_t>(in);
    if (count > most_blocks) throw RunError("these bytes hold no grid");
    return count;
}

void get_tiles(std::istream& in, openvdb::FloatTree& tree) {
    for (std::uint64_t edges = get_count(in); edges > 0; --edges) {
        const auto bits = get<std::int32_t>(in);
        if (bits < openvdb::FloatLeaf::LOG2DIM || bits > 30) throw RunError("these bytes hold no grid");
        for (std::uint64_t tiles = get_count(in); tiles > 0; --tiles) {
            const openvdb::Coord at = get_coord(in);
            const auto value = get<float>(in);
            tree.set_tile(bits, at, {value, get<bool>(in)});
        }
    }
}

}  // namespace

const FieldGrid& grid_of(const Field& field) {
    if (!field.grid || !field.grid->grid) {
        throw RunError(fmt::format("field '{}' has no grid to be recorded", field.name));
    }
    return *field.grid;
}

bool same_field(const FieldGrid& a, const FieldGrid& b) {
    return &a == &b || (a.grid && b.grid && a.box == b.box && bytes_of(a) == bytes_of(b));
}

std::string bytes_of(const FieldGrid& field) {
    const openvdb::FloatGrid& grid = *field.grid;
    std::ostringstream out(std::ios::binary);
    out << mark;
    put(out, grid.voxelSize().x());
    for (int axis = 0; axis < 3; ++axis) put(out, grid.transform().shift()[axis]);
    put(out, grid.background());
    put(out, grid.only_active_values);
    put_tiles(out, grid.tree());
    const std::vector<openvdb::Coord> places = grid.tree().leaf_places();
    put(out, static_cast<std::uint64_t>(places.size()));
    for (const openvdb::Coord& at : places) {
        const openvdb::FloatLeaf& leaf = *grid.tree().probeLeaf(at);
        put_coord(out, at);
        put(out, leaf.getValueMask());
        put(out, leaf.buffer());
    }
    return std::move(out).str();
}

std::shared_ptr<const FieldGrid> grid_from_bytes(const std::string& bytes) {
    std::istringstream in(bytes, std::ios::binary);
    if (get<std::array<char, 4>>(in) != std::array{'E', 'S', 'G', '1'}) throw RunError("these bytes hold no grid");
    const auto transform = openvdb::math::Transform::createLinearTransform(get<double>(in));
    openvdb::Vec3d shift;
    for (int axis = 0; axis < 3; ++axis) shift[axis] = get<double>(in);
    transform->postTranslate(shift);
    auto field = std::make_shared<FieldGrid>();
    field->grid = openvdb::FloatGrid::create(get<float>(in));
    field->grid->setTransform(transform);
    field->grid->only_active_values = get<bool>(in);
    get_tiles(in, field->grid->tree());
    for (std::uint64_t leaves = get_count(in); leaves > 0; --leaves) {
        auto leaf = std::make_unique<openvdb::FloatLeaf>(get_coord(in), 0.0f);
        leaf->getValueMask() = get<openvdb::BlockMask>(in);
        leaf->buffer() = get<openvdb::FloatLeaf::Buffer>(in);
        for (openvdb::Index voxel = 0; voxel < openvdb::FloatLeaf::SIZE; ++voxel) {
            if (leaf->getValueMask().isOn(voxel)) field->box.expand(leaf->offsetToGlobalCoord(voxel));
        }
        field->grid->tree().addLeaf(leaf.release());
    }
    return field;
}

std::uint64_t digest_of(const FieldGrid& grid) {
    if (!grid.grid) return 0;
    const std::string box = fmt::format("{} {} {} {} {} {}", grid.box.min().x(), grid.box.min().y(), grid.box.min().z(),
                                        grid.box.max().x(), grid.box.max().y(), grid.box.max().z());
    return digest(box, digest(bytes_of(grid)));
}

void write_vdb(const std::filesystem::path& path, const Field&) {
    throw RunError(fmt::format("cannot write {}: a page writes no OpenVDB files; the program does", path.string()));
}

}  // namespace espalier::geometry
