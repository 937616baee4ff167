#include "geometry/grids/grid_map.h"

#include "espalier/base/file.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/io/Stream.h>

#include <sstream>

namespace espalier::geometry {
namespace {

using FieldGrids = std::vector<std::shared_ptr<const FieldGrid>>;

openvdb::GridPtrVec read_grids(const std::filesystem::path& path, const Place& place) {
    initialize_openvdb();
    try {
        std::istringstream in(read_text(path), std::ios::binary);
        const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(in, /*delayLoad=*/false).getGrids();
        if (!grids->empty()) return *grids;
    } catch (const UserError& error) {
        throw UserError(place, error.what());
    } catch (const std::exception& error) {
        throw UserError(place, fmt::format("{} is no OpenVDB file: {}", path.string(), error.what()));
    }
    throw UserError(place, fmt::format("{} holds no grid", path.string()));
}

openvdb::GridBase::Ptr chosen_grid(const openvdb::GridPtrVec& grids, const MapSource& source) {
    const std::string wanted = source.grid.empty() ? grids.front()->getName() : source.grid;
    std::vector<std::string> names;
    for (const openvdb::GridBase::Ptr& grid : grids) {
        if (grid->getName() == wanted) return grid;
        names.push_back(grid->getName());
    }
    throw UserError(source.place_of_grid, fmt::format("the file has no grid '{}'{}; it has: {}", wanted,
                                                      did_you_mean(wanted, names), fmt::join(names, ", ")));
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

}  // namespace

GridMap read_grid_map(const MapSource& source) {
    const openvdb::GridBase::Ptr grid = chosen_grid(read_grids(source.path, source.place), source);
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
