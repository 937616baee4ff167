// Fields on disk as .vti, which every viewer of VTK's files opens.
#pragma once

#include "espalier/geometry/field.h"
#include "espalier/timeline/compression.h"

#include <filesystem>

namespace espalier::timeline {

/// The field over its box, with a value at every voxel's centre. The file appears complete or not at all. Throws
/// RunError if the box has more than `most_dense_voxels`.
void write_vti(const std::filesystem::path& path, const Field& field, double time, int step,
               Compression compression = Compression::lz4);

}  // namespace espalier::timeline
