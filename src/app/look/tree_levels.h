// A tree in several levels of detail: meshes, and pictures on cards that cross.
#pragma once

#include "espalier/formats/exporter.h"

#include "formats/levels_file.h"

namespace espalier::app {

/// The plants of a job's one frame: each mesh has a fourth of the triangles of the one before, and the last of `levels`
/// are two cards. Throws UserError if there are too few triangles for so many.
LevelsFile tree_levels(const ExportJob& job, std::size_t levels);

}  // namespace espalier::app
