// Pictures that surfaces wear: from files, or of bark.
#pragma once

#include "archive/meshes/bark.h"

#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <string>

class vtkImageData;

namespace espalier::archive {

/// The picture of a texture's file, as it is named from the scene of the run, from where the run was started, from the
/// run's folder or from here: SGI (.rgb), Targa (.tga), PNG, JPEG, TIFF, BMP or
/// PPM, of at most 2^26 pixels; or the colours of bark. Null if it is not there or is no picture: what wears it then
/// has its own colour. Throws UserError for wrong settings of bark.
vtkSmartPointer<vtkImageData> texture_image(const std::filesystem::path& run, const std::string& file);

/// The first file that a texture's name may mean; "" if there is none.
std::filesystem::path texture_path(const std::filesystem::path& run, const std::string& file);

/// The relief of a texture.
struct ReliefImages {
    vtkSmartPointer<vtkImageData> normals;  ///< in tangent space; null where a texture is flat, as all but bark are
    vtkSmartPointer<vtkImageData> heights;  ///< grey
};
/// The relief as numbers; none where a texture is flat.
std::optional<BarkRelief> bark_relief(const std::filesystem::path& run, const std::string& file);
ReliefImages relief_images(const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::archive
