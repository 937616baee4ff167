#include "geometry/grids/grid_map.h"

#include "espalier/base/file.h"
#include "espalier/base/map_origin.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/text.h"
#include "geometry/grids/vdb_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace espalier::geometry {
namespace {

using FieldGrids = std::vector<std::shared_ptr<const FieldGrid>>;

constexpr const char* origin_metadata = "origin";

/// A grid of vectors of floats and the three grids that are made of it: the most that is held at once.
constexpr std::size_t most_copies = 2;

std::string chosen_name(const std::vector<std::string>& names, const MapSource& source) {
    if (names.empty()) throw UserError(source.place, fmt::format("{} holds no grid", source.path.string()));
    if (source.grid.empty()) return names.front();
    if (std::find(names.begin(), names.end(), source.grid) != names.end()) return source.grid;
    throw UserError(source.place_of_grid, fmt::format("the file has no grid '{}'{}; it has: {}", source.grid,
                                                      did_you_mean(source.grid, names), fmt::join(names, ", ")));
}

std::string bytes_of_file(const MapSource& source) {
    try {
        return read_text(source.path);
    } catch (const UserError& error) {
        throw UserError(source.place, error.what());
    }
}

openvdb::GridBase::Ptr read_grid(const MapSource& source) {
    std::istringstream in(bytes_of_file(source), std::ios::binary);
    const auto fail = [&](const std::exception& error) {
        return UserError(source.place,
                         fmt::format("{} is no OpenVDB file that is read: {}", source.path.string(), error.what()));
    };
    try {
        VdbFile file(in, source.memory / most_copies);
        return file.read(chosen_name(file.names(), source));
    } catch (const VdbError& error) {
        throw fail(error);
    } catch (const openvdb::Exception& error) {
        throw fail(error);
    }
}

/// A grid of floats with what `part` takes of each value.
template <class Grid, class Part>
std::shared_ptr<const FieldGrid> part_of(const Grid& source, const Part& part) {
    const auto floats = openvdb::FloatGrid::create(static_cast<float>(part(source.background())));
    floats->setTransform(source.transform().copy());
    for (auto value = source.cbeginValueOn(); value; ++value) {
        openvdb::CoordBBox box;
        value.getBoundingBox(box);
        floats->fill(box, static_cast<float>(part(*value)));
    }
    return std::make_shared<FieldGrid>(FieldGrid{floats, floats->evalActiveVoxelBoundingBox()});
}

template <class Grid>
bool add_numbers(const openvdb::GridBase& grid, FieldGrids& found) {
    if (!grid.isType<Grid>()) return false;
    found.push_back(part_of(static_cast<const Grid&>(grid), [](const auto& value) { return value; }));
    return true;
}

template <class Grid>
bool add_vectors(const openvdb::GridBase& grid, FieldGrids& found) {
    if (!grid.isType<Grid>()) return false;
    for (int axis = 0; axis < 3; ++axis) {
        found.push_back(part_of(static_cast<const Grid&>(grid), [axis](const auto& value) { return value[axis]; }));
    }
    return true;
}

/// A grid may say where its 0 lies on the map.
openvdb::Vec3d own_origin(const openvdb::GridBase& grid) {
    const auto origin = grid.getMetadata<openvdb::Vec3DMetadata>(origin_metadata);
    return origin ? origin->value() : openvdb::Vec3d(0);
}

void subtract(MapOrigin& origin, openvdb::GridBase& grid, const std::filesystem::path& path) {
    const openvdb::Vec3d own = own_origin(grid);
    const openvdb::CoordBBox voxels = grid.evalActiveVoxelBoundingBox();
    if (voxels.empty()) return;
    const openvdb::BBoxd box = grid.transform().indexToWorld(voxels);
    const auto on_map = [&](const openvdb::Vec3d& at) {
        return glm::dvec3(at.x() + own.x(), at.y() + own.y(), at.z() + own.z());
    };
    const glm::dvec3 subtracted = origin.of(on_map(box.min()), on_map(box.max()), Place{path.string(), 1, 1});
    const openvdb::Vec3d shift = own - openvdb::Vec3d(subtracted.x, subtracted.y, subtracted.z);
    if (shift != openvdb::Vec3d(0)) grid.transform().postTranslate(shift);
}

}  // namespace

GridMap read_grid_map(const MapSource& source) {
    const openvdb::GridBase::Ptr grid = read_grid(source);
    MapOrigin* const origin = MapOrigin::current();
    if (origin && grid->transform().isLinear()) subtract(*origin, *grid, source.path);
    GridMap map{grid->getName(), {}};
    const bool is_known =
        add_numbers<openvdb::FloatGrid>(*grid, map.parts) || add_numbers<openvdb::DoubleGrid>(*grid, map.parts) ||
        add_vectors<openvdb::Vec3SGrid>(*grid, map.parts) || add_vectors<openvdb::Vec3DGrid>(*grid, map.parts);
    if (is_known && grid->transform().isLinear()) return map;
    throw UserError(source.place,
                    fmt::format("the grid '{}' is neither of numbers nor of vectors in a regular lattice", map.grid));
}

bool same_lattice(const GridMap& a, const GridMap& b) {
    return a.parts.size() == b.parts.size() && a.parts.front()->grid->transform() == b.parts.front()->grid->transform();
}

std::shared_ptr<const FieldGrid> mixed(const FieldGrid& before, const FieldGrid& after, double share) {
    const auto grid = openvdb::FloatGrid::create();
    grid->setTransform(before.grid->transform().copy());
    const auto mix = [share](const float& from, const float& to, float& value) {
        value = static_cast<float>(from + share * (double(to) - from));
    };
    grid->tree().combine2(before.grid->tree(), after.grid->tree(), mix);
    openvdb::CoordBBox box = before.box;
    box.expand(after.box);
    return std::make_shared<FieldGrid>(FieldGrid{grid, box});
}

}  // namespace espalier::geometry
