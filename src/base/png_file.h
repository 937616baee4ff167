// Pictures with opacity as the bytes of a PNG file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier {

struct OpacityPicture {
    using Pixel = std::array<std::uint8_t, 4>;  ///< red, green, blue, opacity

    std::size_t width = 0, height = 0;
    std::vector<Pixel> pixels;  ///< row by row, the highest row first

    Pixel& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
    const Pixel& at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

/// Numbers of pixels, such as labels.
struct GreyPicture {
    std::size_t width = 0, height = 0;
    std::vector<std::uint16_t> pixels;  ///< row by row, the highest row first
};

/// Portable Network Graphics of 8 bits a channel (ISO/IEC 15948). Throws RunError.
std::string png_bytes(const OpacityPicture& picture);
/// The same of one channel of 16 bits.
std::string png_bytes(const GreyPicture& picture);

}  // namespace espalier
