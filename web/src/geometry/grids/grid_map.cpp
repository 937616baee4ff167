#include "geometry/grids/grid_map.h"

#include "espalier/geometry/openvdb_grid.h"

#include <fmt/format.h>

namespace espalier::geometry {

GridMap read_grid_map(const MapSource& source) {
    throw UserError(source.place, fmt::format("a page cannot read {}: OpenVDB files need the program that is installed",
                                              source.path.filename().string()));
}

bool same_lattice(const GridMap& a, const GridMap& b) {
    return a.parts.size() == b.parts.size() && a.parts.front()->grid->transform() == b.parts.front()->grid->transform();
}

// Only maps from files are mixed, and none is read here.
std::shared_ptr<const FieldGrid> mixed(const FieldGrid& before, const FieldGrid&, double) {
    return std::make_shared<FieldGrid>(before);
}

}  // namespace espalier::geometry
