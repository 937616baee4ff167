// Pictures of textures for the page, without VTK.
#include "formats/textures.h"

#include "espalier/base/error.h"

#include "archive/meshes/bark.h"
#include "base/picture_file.h"
#include "base/png_file.h"

#include <algorithm>

namespace espalier::formats {
namespace {

OpacityPicture picture_of(const std::filesystem::path& file) {
    const Picture read = read_picture(file);
    OpacityPicture picture{read.width, read.height, std::vector<OpacityPicture::Pixel>(read.width * read.height)};
    for (std::size_t y = 0; y < read.height; ++y) {
        for (std::size_t x = 0; x < read.width; ++x) {
            const std::size_t from = y * read.width + x;
            const auto [red, green, blue] = read.pixels[from];
            picture.at(x, read.height - 1 - y) = {red, green, blue,
                                                  read.opacity.empty() ? std::uint8_t{255} : read.opacity[from]};
        }
    }
    return picture;
}

OpacityPicture bark_picture(const std::filesystem::path& file, TextureMap map) {
    const archive::Bark bark = archive::read_bark(file);
    if (map == TextureMap::colours && bark.picture) return picture_of(*bark.picture);
    const archive::HeightMap heights = archive::heights_of(bark);
    switch (map) {
        case TextureMap::normals:
            return archive::normals_of(bark, heights);
        case TextureMap::heights:
            return archive::grey_of(heights);
        default:
            return archive::shades_of(bark, heights);
    }
}

}  // namespace

std::string png_of(const std::filesystem::path& run, const std::string& file, TextureMap map) {
    const std::filesystem::path path = run / file;
    const bool is_bark = archive::is_bark(file);
    if (!is_bark && map != TextureMap::colours) return "";
    try {
        return png_bytes(is_bark ? bark_picture(path, map) : picture_of(path));
    } catch (const UserError&) {
        return "";
    }
}

}  // namespace espalier::formats
