#include "archive/meshes/bark.h"

#include "espalier/base/random.h"
#include "espalier/base/settings.h"

#include "base/picture_file.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::archive {
namespace {

constexpr std::uint64_t salt = 0x6261726b;
constexpr int most_around = 4;

double faded(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double between(double a, double b, double share) {
    return a + share * (b - a);
}

/// Gradient noise on a lattice that closes around both sides.
class Octave {
public:
    Octave(std::size_t columns, std::size_t rows, RandomKey key, std::uint32_t number)
        : columns_(columns), rows_(rows), gradients_(columns * rows) {
        for (std::size_t i = 0; i < gradients_.size(); ++i) {
            const double angle = 2 * std::numbers::pi * RandomSamples(key, i, number).uniform();
            gradients_[i] = {std::cos(angle), std::sin(angle)};
        }
    }

    /// u and v in [0, 1).
    double at(double u, double v) const {
        const double x = u * static_cast<double>(columns_), y = v * static_cast<double>(rows_);
        const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
        const glm::dvec2 in(x - static_cast<double>(column), y - static_cast<double>(row));
        const auto slope = [&](std::size_t right, std::size_t up) {
            const glm::dvec2& gradient = gradients_[(row + up) % rows_ * columns_ + (column + right) % columns_];
            return glm::dot(gradient, in - glm::dvec2(right, up));
        };
        const double across = faded(in.x);
        return between(between(slope(0, 0), slope(1, 0), across), between(slope(0, 1), slope(1, 1), across),
                       faded(in.y));
    }

private:
    std::size_t columns_, rows_;
    std::vector<glm::dvec2> gradients_;
};

void normalise(std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float value : values) sum += value;
    const double mean = sum / static_cast<double>(values.size());
    for (const float value : values) squares += (value - mean) * (value - mean);
    const double deviation = std::sqrt(squares / static_cast<double>(values.size()));
    for (float& value : values) value = static_cast<float>((value - mean) / deviation);
}

/// A tooth from 0 to 1 and back for each whole number, with a blunt top: ridges are wider than furrows.
double saw(double t) {
    const double down = std::abs(2 * (t - std::floor(t)) - 1);
    return 1 - down * down;
}

HeightMap grown(const Bark& bark) {
    const auto size = static_cast<std::size_t>(bark.size);
    const std::vector<float> shift = brownian_noise(size, mix(bark.seed, 1), 4);
    const std::vector<float> rough = brownian_noise(size, mix(bark.seed, 2));
    HeightMap map{size, size, std::vector<float>(size * size)};
    for (std::size_t i = 0; i < map.heights.size(); ++i) {
        const double u = static_cast<double>(i % size) / static_cast<double>(size);
        const double height = saw(bark.stripes * u + bark.waviness * shift[i]) + bark.roughness * rough[i];
        map.heights[i] = static_cast<float>(std::clamp(height, 0.0, 1.0));
    }
    return map;
}

HeightMap read_heights(const std::filesystem::path& file) {
    const Picture picture = read_picture(file);
    HeightMap map{picture.width, picture.height, {}};
    for (const auto& [red, green, blue] : picture.pixels) {
        map.heights.push_back(static_cast<float>(0.299 * red + 0.587 * green + 0.114 * blue) / 255);
    }
    return map;
}

/// Pictures run from the highest row down.
template <class Colour>
OpacityPicture painted(const HeightMap& map, const Colour& colour) {
    OpacityPicture picture{map.width, map.height, {}};
    picture.pixels.resize(map.heights.size());
    for (std::size_t y = 0; y < map.height; ++y) {
        for (std::size_t x = 0; x < map.width; ++x) picture.at(x, map.height - 1 - y) = colour(x, y);
    }
    return picture;
}

std::uint8_t byte(double share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

bool is_bark(const std::string& texture) {
    return texture.ends_with(".bark");
}

int pictures_around(const std::string& texture, float radius, float thickest) {
    if (texture.empty()) return 0;
    if (!is_bark(texture) || !(thickest > 0)) return 1;
    return std::max(1, static_cast<int>(std::lround(most_around * radius / thickest)));
}

Bark read_bark(const std::filesystem::path& path) {
    const Settings settings = Settings::read_toml(path);
    Bark bark;
    bark.stripes = static_cast<int>(settings.integer_or("stripes", bark.stripes, Range::between(0, 1000)));
    bark.waviness = settings.number_or("waviness", bark.waviness, Range::between(0, 100));
    bark.roughness = settings.number_or("roughness", bark.roughness, Range::between(0, 100));
    bark.depth = settings.number_or("depth", bark.depth, Range::between(0, 1));
    bark.darkness = settings.number_or("darkness", bark.darkness, Range::between(0, 1));
    bark.size = static_cast<int>(settings.integer_or("size", bark.size, Range::between(16, 4096)));
    bark.seed = static_cast<std::uint64_t>(settings.integer_or("seed", 1, Range::not_negative()));
    bark.heights = settings.path_if_any("heights");
    bark.picture = settings.path_if_any("picture");
    settings.reject_unread();
    return bark;
}

std::vector<float> brownian_noise(std::size_t size, std::uint64_t seed, std::size_t length_by_width) {
    const RandomKey key(seed, 0, Stream::placement, salt);
    std::vector<Octave> octaves;
    for (std::size_t rows = 2; 2 * rows * length_by_width <= size; rows *= 2) {
        octaves.emplace_back(rows * length_by_width, rows, key, static_cast<std::uint32_t>(octaves.size()));
    }
    std::vector<float> values(size * size);
    tbb::parallel_for(std::size_t{0}, size, [&](std::size_t row) {
        for (std::size_t column = 0; column < size; ++column) {
            const double u = static_cast<double>(column) / static_cast<double>(size);
            const double v = static_cast<double>(row) / static_cast<double>(size);
            double sum = 0, amplitude = 1;
            for (const Octave& octave : octaves) {
                sum += amplitude * octave.at(u, v);
                amplitude *= std::numbers::sqrt2 / 2;
            }
            values[row * size + column] = static_cast<float>(sum);
        }
    });
    normalise(values);
    return values;
}

HeightMap heights_of(const Bark& bark) {
    return bark.heights ? read_heights(*bark.heights) : grown(bark);
}

double BarkRelief::furrow(double u, double v) const {
    const double x = (u - std::floor(u)) * static_cast<double>(map.width) + static_cast<double>(map.width) - 0.5;
    const double y = (v - std::floor(v)) * static_cast<double>(map.height) + static_cast<double>(map.height) - 0.5;
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    const double right = x - static_cast<double>(column), up = y - static_cast<double>(row);
    const auto at = [&](std::size_t a, std::size_t b) { return double(map.at((column + a) % map.width, row + b)); };
    return depth * (1 - between(between(at(0, 0), at(1, 0), right), between(at(0, 1), at(1, 1), right), up));
}

OpacityPicture shades_of(const Bark& bark, const HeightMap& map) {
    return painted(map, [&](std::size_t x, std::size_t y) -> OpacityPicture::Pixel {
        const std::uint8_t shade = byte(1 - bark.darkness * (1 - map.at(x, y)));
        return {shade, shade, shade, 255};
    });
}

OpacityPicture grey_of(const HeightMap& map) {
    return painted(map, [&](std::size_t x, std::size_t y) -> OpacityPicture::Pixel {
        const std::uint8_t grey = byte(map.at(x, y));
        return {grey, grey, grey, 255};
    });
}

OpacityPicture normals_of(const Bark& bark, const HeightMap& map) {
    const double steep = bark.depth * static_cast<double>(map.width) / 2;
    return painted(map, [&](std::size_t x, std::size_t y) -> OpacityPicture::Pixel {
        const double along_u = map.at(x + 1, y) - map.at(x + map.width - 1, y);
        const double along_v = map.at(x, y + 1) - map.at(x, y + map.height - 1);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-steep * along_u, -steep * along_v, 1));
        return {byte(0.5 + 0.5 * normal.x), byte(0.5 + 0.5 * normal.y), byte(0.5 + 0.5 * normal.z), 255};
    });
}

}  // namespace espalier::archive
