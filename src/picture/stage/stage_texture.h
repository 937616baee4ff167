// Picture files that surfaces wear.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <filesystem>
#include <string>

namespace espalier::picture {

/// Of `texture_image`; null where that is.
vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::picture
