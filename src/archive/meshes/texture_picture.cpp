#include "archive/meshes/texture_picture.h"

#include "archive/meshes/texture_file.h"

#include <vtkImageData.h>

#include <cstdint>

namespace espalier::archive {

std::shared_ptr<const OpacityPicture> texture_picture(const std::filesystem::path& run, const std::string& file) {
    const auto image = texture_image(run, file);
    if (!image || image->GetScalarType() != VTK_UNSIGNED_CHAR) return nullptr;
    const int* size = image->GetDimensions();
    const int parts = image->GetNumberOfScalarComponents();
    const auto* from = static_cast<const std::uint8_t*>(image->GetScalarPointer());
    OpacityPicture picture{static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]), {}};
    picture.pixels.resize(picture.width * picture.height);
    for (std::size_t y = picture.height; y-- > 0;) {
        for (std::size_t x = 0; x < picture.width; ++x, from += parts) {
            const bool is_grey = parts < 3;
            picture.at(x, y) = {from[0], from[is_grey ? 0 : 1], from[is_grey ? 0 : 2],
                                parts == 4 || parts == 2 ? from[parts - 1] : std::uint8_t{255}};
        }
    }
    return std::make_shared<const OpacityPicture>(std::move(picture));
}

}  // namespace espalier::archive
