#include "picture/stage/stage_texture.h"

#include "archive/meshes/texture_file.h"

#include <vtkImageData.h>

namespace espalier::picture {

vtkSmartPointer<vtkTexture> texture_of(const std::filesystem::path& run, const std::string& file) {
    const auto image = texture_image(run, file);
    if (!image) return nullptr;
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    texture->InterpolateOn();
    texture->MipmapOn();
    texture->RepeatOn();
    return texture;
}

}  // namespace espalier::picture
