// Grids on disk and in comparison: .vdb files with the same bytes for the same grid.
#pragma once

#include "espalier/geometry/field.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace espalier::geometry {

/// An array over a field's box has at most this many voxels.
inline constexpr std::uint64_t most_dense_voxels = std::uint64_t{1} << 28;

/// The field's grid. Throws RunError if it has none.
const FieldGrid& grid_of(const Field& field);

/// True if both give the same files but for the time.
bool same_field(const FieldGrid& a, const FieldGrid& b);

/// The same for grids that are the same_field, and hardly ever for others.
std::uint64_t digest_of(const FieldGrid& grid);

/// All values of a grid, and the grid that they are of. Throws RunError for bytes that are none.
std::string bytes_of(const FieldGrid& grid);
std::shared_ptr<const FieldGrid> grid_from_bytes(const std::string& bytes);

/// Active values only, compressed by Blosc if there are many. The file appears complete or not at all. Throws RunError.
void write_vdb(const std::filesystem::path& path, const Field& field);

}  // namespace espalier::geometry
