// Picture files that surfaces wear.
#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <filesystem>
#include <string>

namespace espalier::picture {

/// Makes a texture of `texture_image`; null where that is.
vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file);

/// Lets light see the relief of a texture on the actor that wears it, which must be lit; nothing if it has none.
void add_relief(vtkActor& actor, const std::filesystem::path& run, const std::string& file);

}  // namespace espalier::picture
