// Files of pictures, of the ground or on surfaces: SGI (.rgb), Targa (.tga), PNG, bitmaps (.bmp) and pixmaps (.ppm).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace espalier {

struct Picture {
    using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

    std::size_t width = 0, height = 0;
    std::vector<Colour> pixels;         ///< row by row, the lowest row first
    std::vector<std::uint8_t> opacity;  ///< of each pixel, 0 to 255; empty: all are opaque, as those of .rgb and .tga

    bool empty() const { return pixels.empty(); }
    /// The pixel over a place, u and v running from 0 at the lower left corner to 1 at the upper right.
    const Colour& at(double u, double v) const;
};

/// SGI's and Targa's are known by the last three letters of the name, the others by their first bytes. Throws
/// UserError, naming the file, if it is no such picture, ends too early or has more than 2^28 pixels.
Picture read_picture(const std::filesystem::path& path);

constexpr std::size_t most_pixels_of_texture = std::size_t{1} << 26;

/// Why a file cannot be shown on a surface, as far as its first bytes tell: it is no picture of a kind that is read,
/// which for surfaces may also be JPEG or TIFF, or is too large. Empty if nothing speaks against it.
std::string reason_not_to_show(const std::filesystem::path& path);

}  // namespace espalier
