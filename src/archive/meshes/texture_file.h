// Picture files that surfaces wear.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>

class vtkImageData;

namespace espalier::archive {

/// The picture of a texture's file, as it is named or beside the run: SGI (.rgb), Targa (.tga), PNG, JPEG, TIFF, BMP or
/// PNM. Null if it is not there or is no picture: what wears it then has its own colour.
vtkSmartPointer<vtkImageData> texture_image(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::archive

namespace espalier {

using archive::texture_image;

}  // namespace espalier
