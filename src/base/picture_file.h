// Files of pictures, of the ground or on surfaces: SGI (.rgb), Targa (.tga) and PNG (.png) files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// The kind follows from the last three letters of the name. Throws UserError, naming the file, if it is no such
/// picture, ends too early or has more than 2^28 pixels.
Picture read_picture(const std::filesystem::path& path);

}  // namespace espalier
