#include "environment/soil/richards/cells.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

bool in_layer(const SoilLayer& layer, const glm::dvec3& point) {
    const double y = point.y - layer.rise * point.x;
    return y >= layer.heights.bottom && y < layer.heights.top;
}

/// The kind that a field of whole numbers says, the value of the nearest voxel.
std::size_t kind_in_field(const SoilParameters& soil, const FieldGrid& map, const glm::dvec3& point) {
    const openvdb::Vec3d at = map.grid->worldToIndex(openvdb::Vec3d(point.x, point.y, point.z));
    const double value = std::round(map.grid->tree().getValue(openvdb::Coord::round(at)));
    if (value >= 0 && value < static_cast<double>(soil.map_kinds.size())) {
        return soil.map_kinds[static_cast<std::size_t>(value)];
    }
    throw UserError(
        soil.space.place,
        fmt::format("the map '{}' is {} at ({:.3g}, {:.3g}, {:.3g}), but 'soils' has {} names, "
                    "counted from 0",
                    soil.map_field, format_general(value), point.x, point.y, point.z, soil.map_kinds.size()));
}

}  // namespace

void FaceCouplings::resize(std::size_t cells) {
    for (WaterBrick* brick : {&by_own, &by_next}) brick->assign(cells, 0.0);
}

void FaceFluxes::resize(std::size_t cells) {
    FaceCouplings::resize(cells);
    flux.assign(cells, 0.0);
}

SoilLayout::SoilLayout(const WaterGrid& grid, const SoilParameters& parameters,
                       const std::vector<std::uint8_t>& free_voxels, const Fields& fields)
    : rows_(grid, parameters.periodic),
      parameters_(parameters),
      kinds_(parameters.kinds),
      faces_(grid, free_voxels),
      kind_of_(grid.cells(), static_cast<std::uint8_t>(parameters.kind)),
      edge_(100 * grid.voxel()) {
    place_kinds(fields);
}

void SoilLayout::place_kinds(const Fields& fields) {
    const FieldGrid* const map =
        parameters_.map_field.empty() ? nullptr : fields.need(parameters_.map_field).grid.get();
    const Box box{grid().lower(), grid().upper()};
    grid().for_each_cell([&](std::size_t cell) {
        const glm::dvec3 point = grid().centre(grid().voxel_of(cell));
        std::optional<std::size_t> kind;
        if (map) kind = kind_in_field(parameters_, *map, point);
        if (!parameters_.map_file.empty()) kind = parameters_.map_kinds[parameters_.map_file.at(point, box)];
        for (const SoilLayer& layer : parameters_.layers) {
            if (layer.kind && in_layer(layer, point)) kind = layer.kind;
        }
        for (const SoilRegion& region : parameters_.regions) {
            if (region.kind && region.shape->inside(point)) kind = region.kind;
        }
        if (kind) kind_of_[cell] = static_cast<std::uint8_t>(*kind);
    });
}

const SoilBeginning& SoilLayout::beginning(const glm::dvec3& point) const {
    const SoilBeginning* found = &parameters_.beginning;
    for (const SoilLayer& layer : parameters_.layers) {
        if (layer.beginning && in_layer(layer, point)) found = &*layer.beginning;
    }
    for (const SoilRegion& region : parameters_.regions) {
        if (region.beginning && region.shape->inside(point)) found = &*region.beginning;
    }
    return *found;
}

NeighbourRows SoilRows::neighbours(std::size_t row) const {
    const glm::ivec3 size = grid_.size();
    const int y = grid_.y_of(row), z = grid_.z_of(row);
    const auto begin = [&](int at_y, int at_z) { return grid_.row_begin(std::size_t(at_z) * size.y + at_y); };
    const int back = z > 0 ? z - 1 : joined_z_ ? size.z - 1 : z;
    const int front = z + 1 < size.z ? z + 1 : joined_z_ ? 0 : z;
    return {begin(y, z),
            begin(std::max(y - 1, 0), z),
            begin(std::min(y + 1, size.y - 1), z),
            begin(y, back),
            begin(y, front),
            y + 1 < size.y,
            front != z};
}

void SoilRows::wrap(double* row) const {
    const int n = grid_.size().x;
    row[-1] = joined_x_ ? row[n - 1] : 0;
    row[n] = joined_x_ ? row[0] : 0;
}

}  // namespace espalier::environment
