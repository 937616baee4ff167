// Fields on disk: .vdb for OpenVDB, .vti for every viewer; the same bytes for the same grid.
#pragma once

#include "espalier/geometry/field.h"

#include <cstdint>
#include <filesystem>

namespace espalier {

/// True if both would give the same files but for the time.
bool same_field(const FieldGrid& a, const FieldGrid& b);

/// The same for grids that are the same_field, and hardly ever for others.
std::uint64_t digest_of(const FieldGrid& grid);

/// Complete or not at all; active values only, by Blosc where they are many. Throws RunError.
void write_vdb(const std::filesystem::path& path, const Field& field);

/// The field over its box as a .vti with a value at every voxel's centre. Throws RunError if that is more than
/// `most_vti_voxels`.
void write_vti(const std::filesystem::path& path, const Field& field, double time, int step);
inline constexpr std::uint64_t most_vti_voxels = std::uint64_t{1} << 28;

}  // namespace espalier
