// Picture files that surfaces wear.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <filesystem>
#include <string>

namespace espalier {

/// The texture of a file, as it is named or beside the run; null if it is not there or of a kind that VTK does not read
/// (it reads PNG, JPEG, TIFF, BMP and PNM): what wears it then has its own colour.
vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier
