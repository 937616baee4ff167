// Grids of OpenVDB files, as other programs write them: maps of numbers or vectors.
#pragma once

#include "espalier/base/error.h"
#include "espalier/geometry/field.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace espalier::geometry {

/// What a file holds of a field: a grid of numbers, or one for each component of vectors.
struct GridMap {
    std::string grid;  ///< name in the file
    std::vector<std::shared_ptr<const FieldGrid>> parts;
};

/// Which grid of a file, and where a user wrote that.
struct MapSource {
    std::filesystem::path path;
    Place place;       ///< of the path
    std::string grid;  ///< empty: the first
    Place place_of_grid;
    std::size_t memory = std::size_t(-1);  ///< most bytes that reading it may take
};

/// Its places are relative to the current origin of a scene. Throws UserError at the places of `source`.
GridMap read_grid_map(const MapSource& source);

/// True if both have numbers, or both vectors, in one lattice.
bool same_lattice(const GridMap& a, const GridMap& b);

/// Values `share` of the way from `before` to `after`, which have one lattice.
std::shared_ptr<const FieldGrid> mixed(const FieldGrid& before, const FieldGrid& after, double share);

}  // namespace espalier::geometry
