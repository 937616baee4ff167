// Bark without a picture: stripes along the axis by a saw-tooth, moved and roughened by Brownian noise (Oppenheimer
// 1986); or relief and colour from pictures of real bark (Bloomenthal 1985). Settings stand in a file of their own.
#pragma once

#include "base/png_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier::archive {

/// Whether a texture's file holds settings of bark: its name ends in ".bark".
bool is_bark(const std::string& texture);

/// How many pictures of a texture lie around an axis: 1; of bark 4 around the thickest axis, fewer around thinner ones.
/// 0 for no texture.
int pictures_around(const std::string& texture, float radius, float thickest);

/// One picture of bark, which continues itself at all four sides.
struct Bark {
    int stripes = 10;         ///< from side to side
    double waviness = 0.25;   ///< standard deviation of the noise that moves stripes, in stripes
    double roughness = 0.04;  ///< strength of the noise that is added to their height, as a share of it
    double depth = 0.03;      ///< from ridges to cracks, as a share of the picture's width
    double darkness = 0.55;   ///< how dark cracks are; 0: as bright as ridges
    int size = 512;           ///< pixels along a side
    std::uint64_t seed = 1;
    std::optional<std::filesystem::path> heights;  ///< a picture whose brightness is the height, instead of the above
    std::optional<std::filesystem::path> picture;  ///< a picture of the colours, instead of the axis's own
};

/// Reads a file of settings (TOML). Throws UserError with file and line.
Bark read_bark(const std::filesystem::path& path);

/// Heights from 0 to 1, row by row, the lowest row first.
struct HeightMap {
    std::size_t width = 0, height = 0;
    std::vector<float> heights;

    float at(std::size_t x, std::size_t y) const { return heights[y % height * width + x % width]; }
};

/// Noise that repeats after 1 in u and v: a sum of octaves of gradient noise (Perlin 1985) whose amplitudes fall with
/// the root of the frequency, so that the power spectrum along a line falls with its square, as that of Brownian motion
/// (Mandelbrot & Van Ness 1968). `size` x `size` values of mean 0 and deviation 1; `length_by_width` is the shape of
/// its waves, a power of 2.
std::vector<float> brownian_noise(std::size_t size, std::uint64_t seed, std::size_t length_by_width = 1);

/// Throws UserError if the picture of heights cannot be read.
HeightMap heights_of(const Bark& bark);

/// How far bark is below its ridges.
struct BarkRelief {
    double depth;  ///< depth of the deepest furrow, as a share of a picture's width
    HeightMap map;

    /// At a place of the texture, in pictures, as a share of a picture's width; linear between pixels. Not below 0.
    double furrow(double u, double v) const;
};

/// Brightness by height, to be multiplied by the colour of the axis.
OpacityPicture shades_of(const Bark& bark, const HeightMap& map);
/// The heights as shades of grey.
OpacityPicture grey_of(const HeightMap& map);
/// Unit normals in the tangent space of u (red), v (green) and outwards (blue): 2 x colour - 1.
OpacityPicture normals_of(const Bark& bark, const HeightMap& map);

}  // namespace espalier::archive
