// fields/NAME/NNNN.vti and .vdb, read back.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/geometry/field.h"

namespace espalier::archive {

/// Reads the box of a .vdb's active voxels, or what the .vti holds. Throws UserError naming the file.
RecordedField read_field(const std::filesystem::path& path, const std::string& name);
/// The same as a grid of its own.
Field read_grid(const std::filesystem::path& path, const std::string& name);

}  // namespace espalier::archive
