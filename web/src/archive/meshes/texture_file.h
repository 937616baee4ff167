// Pictures that surfaces wear: where their files are.
#pragma once

#include "archive/meshes/bark.h"

#include <filesystem>
#include <optional>
#include <string>

namespace espalier::archive {

/// The file that a texture's name means; "" if there is none.
std::filesystem::path texture_path(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::archive
