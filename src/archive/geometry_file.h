// plants/NNNN.vtp, lifespans.vtp and background.vtp, read back.
#pragma once

#include "espalier/archive/recorded_run.h"

namespace espalier::archive {

/// Throw UserError naming the file.
FrameGeometry read_geometry(const std::filesystem::path& path);
RecordedLives read_lives(const std::filesystem::path& path);
RecordedBackground read_background(const std::filesystem::path& path);

}  // namespace espalier::archive
