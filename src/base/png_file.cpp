#include "base/png_file.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <png.h>

namespace espalier {

std::string png_bytes(const OpacityPicture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGBA;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr)) {
        throw RunError(fmt::format("a picture of {} x {} pixels cannot become PNG: {}", picture.width, picture.height,
                                   image.message));
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace espalier
