// Pictures that surfaces wear, as pixels with opacity.
#pragma once

#include "base/png_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace espalier::archive {

/// The picture of a texture's file, which is looked for as `texture_image` does; null if there is none.
std::shared_ptr<const OpacityPicture> texture_picture(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::archive
