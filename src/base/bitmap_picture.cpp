#include "base/picture_bytes.h"

namespace espalier {
namespace {

/// The fields of the two headers of a bitmap, by their places in the file.
enum Field : std::size_t { begin_of_pixels = 10, size_of_header = 14, width = 18, height = 22, bits = 28, coding = 30 };

constexpr std::size_t file_header = 14, least_header = 40;

}  // namespace

Picture read_bitmap(const PictureBytes& bytes) {
    if (!bytes.begins_with("BM")) bytes.fail("this is no bitmap");
    const std::size_t depth = bytes.little(bits), header = bytes.little4(size_of_header);
    if (header < least_header || bytes.little4(coding) != 0 || (depth != 8 && depth != 24 && depth != 32)) {
        bytes.fail("only bitmaps that are not compressed, of 8, 24 or 32 bits a pixel, can be read");
    }
    const auto signed_height = static_cast<std::int32_t>(bytes.little4(height));
    const bool top_first = signed_height < 0;
    Picture image{bytes.little4(width), static_cast<std::size_t>(std::abs(std::int64_t{signed_height})), {}, {}};
    bytes.require_size(image.width, image.height, 1);
    image.pixels.resize(image.width * image.height);
    const std::size_t palette = file_header + header, first = bytes.little4(begin_of_pixels);
    const std::size_t row_size = (image.width * depth / 8 + 3) / 4 * 4;
    for (std::size_t row = 0; row < image.height; ++row) {
        const std::size_t line = top_first ? image.height - 1 - row : row;
        for (std::size_t x = 0; x < image.width; ++x) {
            const std::size_t at = first + row * row_size + x * (depth / 8);
            const std::size_t colour = depth == 8 ? palette + 4u * bytes.at(at) : at;
            image.pixels[line * image.width + x] = {bytes.at(colour + 2), bytes.at(colour + 1), bytes.at(colour)};
        }
    }
    return image;
}

}  // namespace espalier
