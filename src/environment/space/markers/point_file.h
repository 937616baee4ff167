// Points of files: scanned ones, or the corners of meshes.
#pragma once

#include "espalier/base/settings.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace espalier::environment {

/// The points of `file` of a table, .ply, .obj, .xyz, .txt, .csv, .asc or .pts, in metres with y upwards, less the
/// current origin of a scene. The table's `unit` and `up` say what the file's are. Throws UserError for files that are
/// none, have no points or more than `most`. What is in the file and not used is named in `warnings`, which may be
/// null.
std::vector<glm::dvec3> read_point_file(const Settings& table, std::size_t most, std::vector<Diagnostic>* warnings);

}  // namespace espalier::environment
