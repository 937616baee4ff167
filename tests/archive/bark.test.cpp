// Bark from numbers alone: the spectrum of its stripes and of its noise, and the relief that follows from them.
#include "archive/meshes/bark.h"

#include "espalier/base/error.h"

#include "archive/meshes/texture_file.h"
#include "catch.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vtkImageData.h>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::archive;
using Catch::Contains;

namespace {

/// The power of whole frequencies up to a quarter of the size along rows, mean of every eighth row.
std::vector<double> spectrum(const std::vector<float>& values, std::size_t size) {
    std::vector<double> power(size / 4);
    for (std::size_t row = 0; row < size; row += 8) {
        for (std::size_t f = 1; f < power.size(); ++f) {
            double re = 0, im = 0;
            for (std::size_t x = 0; x < size; ++x) {
                const double angle = 2 * std::numbers::pi * double(f * x % size) / double(size);
                re += values[row * size + x] * std::cos(angle);
                im += values[row * size + x] * std::sin(angle);
            }
            power[f] += re * re + im * im;
        }
    }
    return power;
}

/// Returns the slope of the logarithm of power by that of frequency, from octaves of equal weight.
double slope(const std::vector<double>& power, std::size_t from, std::size_t to) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t low = from; low < to; low *= 2) {
        double mean = 0;
        for (std::size_t f = low; f < 2 * low; ++f) mean += power[f] / double(low);
        const double x = std::log(1.5 * double(low)), y = std::log(mean);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

TEST_CASE("the power of the noise falls with the square of the frequency, as that of Brownian motion", "[bark]") {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        INFO(seed);
        CHECK(slope(spectrum(brownian_noise(512, seed), 512), 2, 128) == Approx(-2).margin(0.3));
    }
}

TEST_CASE("the spectrum of bark has its peak at the frequency of the stripes", "[bark]") {
    for (const int stripes : {7, 10, 16}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            Bark bark;
            bark.stripes = stripes;
            bark.seed = seed;
            const HeightMap map = heights_of(bark);
            const std::vector<double> power = spectrum(map.heights, map.width);
            const auto peak = std::max_element(power.begin(), power.end()) - power.begin();
            INFO(stripes << " stripes, seed " << seed);
            CHECK(std::abs(peak - stripes) <= 1);
        }
    }
}

TEST_CASE("bark continues itself at all sides, is the same for the same seed and another for another", "[bark]") {
    Bark bark;
    bark.size = 128;
    const HeightMap map = heights_of(bark);
    CHECK(heights_of(bark).heights == map.heights);
    // No step across the border is larger than those inside.
    float inside = 0, across = 0;
    for (std::size_t y = 0; y < 128; ++y) {
        for (std::size_t x = 0; x < 128; ++x) {
            const float step =
                std::max(std::abs(map.at(x + 1, y) - map.at(x, y)), std::abs(map.at(x, y + 1) - map.at(x, y)));
            float& most = x == 127 || y == 127 ? across : inside;
            most = std::max(most, step);
        }
    }
    CHECK(across <= 1.2f * inside);
    bark.seed = 2;
    CHECK(heights_of(bark).heights != map.heights);
}

TEST_CASE("normals of bark stand across the slope of its heights", "[bark]") {
    Bark bark;
    bark.stripes = 4;
    bark.waviness = bark.roughness = 0;
    bark.size = 256;
    bark.depth = 0.05;
    const OpacityPicture normals = normals_of(bark, heights_of(bark));
    // A tooth rises by 1 in an eighth of the width.
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.05 * 8, 0, 1));
    const auto& rising = normals.at(16, 100);
    const auto& falling = normals.at(48, 100);
    for (int k = 0; k < 3; ++k) CHECK(rising[k] / 127.5 - 1 == Approx(expected[k]).margin(0.01));
    CHECK(falling[0] / 127.5 - 1 == Approx(-expected.x).margin(0.01));
}

TEST_CASE("a file of settings is a texture with a relief; a picture is one without", "[bark]") {
    const TemporaryFolder folder;
    const std::string file = folder.write("oak.bark", "stripes = 5\nsize = 64\n");
    const auto image = texture_image(folder.path(), "oak.bark");
    REQUIRE(image);
    CHECK(image->GetDimensions()[0] == 64);
    const ReliefImages relief = relief_images(folder.path(), file);
    REQUIRE(relief.normals);
    REQUIRE(relief.heights);
    CHECK_FALSE(relief_images(folder.path(), "leaf.png").normals);
    CHECK_FALSE(texture_image(folder.path(), "gone.bark"));
    CHECK_FALSE(relief_images(folder.path(), "gone.bark").normals);
}

TEST_CASE("the relief of bark may be a picture of real bark", "[bark]") {
    const TemporaryFolder folder;
    OpacityPicture scan{32, 16, {}};
    for (int i = 0; i < 32 * 16; ++i) {
        const auto grey = static_cast<std::uint8_t>(8 * (i % 32));
        scan.pixels.push_back({grey, grey, grey, 255});
    }
    folder.write("scan.png", png_bytes(scan));
    const Bark bark = read_bark(folder.write("scan.bark", "heights = \"scan.png\"\ndepth = 0.1\n"));
    const HeightMap map = heights_of(bark);
    CHECK(map.width == 32);
    CHECK(map.height == 16);
    CHECK(map.at(31, 3) == Approx(248 / 255.0));
    CHECK_THROWS_WITH(heights_of(read_bark(folder.write("none.bark", "heights = \"none.png\"\n"))),
                      Contains("none.png"));
}

TEST_CASE("wrong settings of bark are named with their line", "[bark]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(read_bark(folder.write("a.bark", "stripes = 5\ndepht = 1\n")),
                      Contains("a.bark:2") && Contains("depth"));
    CHECK_THROWS_WITH(read_bark(folder.write("b.bark", "stripes = -1\n")), Contains("b.bark:1"));
}

TEST_CASE("four pictures of bark lie around the thickest axis, one around thin ones", "[bark]") {
    CHECK(pictures_around("oak.bark", 0.4f, 0.4f) == 4);
    CHECK(pictures_around("oak.bark", 0.2f, 0.4f) == 2);
    CHECK(pictures_around("oak.bark", 0.01f, 0.4f) == 1);
    CHECK(pictures_around("oak.png", 0.4f, 0.4f) == 1);
    CHECK(pictures_around("", 0.4f, 0.4f) == 0);
}
