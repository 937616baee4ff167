#include "base/png_file.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <png.h>

namespace espalier {

namespace {

std::string written(std::size_t width, std::size_t height, png_uint_32 format, const void* pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr)) {
        throw RunError(fmt::format("a picture of {} x {} pixels cannot become PNG: {}", width, height, image.message));
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string png_bytes(const OpacityPicture& picture) {
    return written(picture.width, picture.height, PNG_FORMAT_RGBA, picture.pixels.data());
}

std::string png_bytes(const GreyPicture& picture) {
    return written(picture.width, picture.height, PNG_FORMAT_LINEAR_Y, picture.pixels.data());
}

}  // namespace espalier
