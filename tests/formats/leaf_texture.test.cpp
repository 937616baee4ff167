// Pictures of leaf clusters: as many blobs as asked for, on nothing.
#include "formats/leaf_texture.h"

#include "espalier/base/error.h"

#include "base/picture_file.h"
#include "catch.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace espalier;
using Catch::Contains;

namespace {

/// Sets of opaque pixels that touch by side or corner.
std::size_t count_of_blobs(const OpacityPicture& picture) {
    std::vector<bool> seen(picture.pixels.size(), false);
    std::size_t blobs = 0;
    for (std::size_t start = 0; start < seen.size(); ++start) {
        if (seen[start] || picture.pixels[start][3] == 0) continue;
        ++blobs;
        std::vector<std::size_t> open{start};
        seen[start] = true;
        while (!open.empty()) {
            const std::size_t at = open.back(), x = at % picture.width, y = at / picture.width;
            open.pop_back();
            for (std::size_t ny = y == 0 ? 0 : y - 1; ny <= std::min(y + 1, picture.height - 1); ++ny) {
                for (std::size_t nx = x == 0 ? 0 : x - 1; nx <= std::min(x + 1, picture.width - 1); ++nx) {
                    const std::size_t next = ny * picture.width + nx;
                    if (seen[next] || picture.pixels[next][3] == 0) continue;
                    seen[next] = true;
                    open.push_back(next);
                }
            }
        }
    }
    return blobs;
}

double covered_share(const OpacityPicture& picture) {
    const auto is_opaque = [](const OpacityPicture::Pixel& pixel) { return pixel[3] > 0; };
    return double(std::count_if(picture.pixels.begin(), picture.pixels.end(), is_opaque)) /
           double(picture.pixels.size());
}

}  // namespace

TEST_CASE("a leaf texture has as many blobs as asked for, and nothing elsewhere", "[leaf-texture]") {
    for (const std::size_t blobs : {1u, 7u, 60u, 300u}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            LeafTexture texture;
            texture.blobs = blobs;
            texture.seed = seed;
            if (blobs < 10) texture.coverage = 0.1;
            const LeafPicture leaves = leaf_picture(texture);
            INFO(blobs << " blobs, seed " << seed);
            CHECK(leaves.overlapping == 0);
            CHECK(count_of_blobs(leaves.picture) == blobs);
            CHECK(covered_share(leaves.picture) == Approx(texture.coverage).epsilon(0.45));
            std::set<int> opacities;
            for (const auto& pixel : leaves.picture.pixels) opacities.insert(pixel[3]);
            CHECK(opacities == std::set<int>{0, 255});
        }
    }
}

TEST_CASE("blobs have the colour asked for, within the variation", "[leaf-texture]") {
    LeafTexture texture;
    texture.rgb = {100, 150, 50};
    texture.variation = 0.1;
    const OpacityPicture picture = leaf_picture(texture).picture;
    double red = 0, green = 0;
    for (const auto& pixel : picture.pixels) {
        if (pixel[3] == 0) {
            CHECK(std::equal(texture.rgb.begin(), texture.rgb.end(), pixel.begin()));  // what filters mix in
            break;
        }
    }
    for (const auto& pixel : picture.pixels) {
        if (pixel[3] == 0) continue;
        red += pixel[0];
        green += pixel[1];
        const bool is_near = pixel[0] > 100 * 0.9 * 0.9 && pixel[0] < 100 * 1.1 * 1.1;
        if (!is_near) CHECK(int(pixel[0]) == 100);
    }
    CHECK(red / green == Approx(100.0 / 150).epsilon(0.02));
}

TEST_CASE("equal seeds give equal bytes, others do not", "[leaf-texture]") {
    LeafTexture texture;
    const std::string bytes = png_bytes(leaf_picture(texture).picture);
    CHECK(png_bytes(leaf_picture(texture).picture) == bytes);
    texture.seed = 1;
    CHECK(png_bytes(leaf_picture(texture).picture) != bytes);
}

TEST_CASE("a leaf texture reads back as a PNG", "[leaf-texture]") {
    const TemporaryFolder folder;
    LeafTexture texture;
    texture.size = 64;
    texture.blobs = 5;
    const OpacityPicture drawn = leaf_picture(texture).picture;
    const Picture read = read_picture(folder.write("leaves.png", png_bytes(drawn)));
    REQUIRE(read.width == 64);
    REQUIRE(read.height == 64);
    for (std::size_t y = 0; y < 64; ++y) {
        for (std::size_t x = 0; x < 64; ++x) {
            const auto& pixel = drawn.at(x, 63 - y);
            if (read.pixels[y * 64 + x] != Picture::Colour{pixel[0], pixel[1], pixel[2]}) FAIL(x << ", " << y);
        }
    }
}

TEST_CASE("blobs too small to be seen are refused", "[leaf-texture]") {
    LeafTexture texture;
    texture.size = 16;
    texture.blobs = 1000;
    CHECK_THROWS_WITH(leaf_picture(texture), Contains("1000 blobs") && Contains("larger --size"));
}

TEST_CASE("a twig stands on the middle of the lower edge, its leaves hang together, and the rim stays free",
          "[leaf-texture]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        INFO("seed " << seed);
        LeafTexture texture;
        texture.form = LeafTexture::Form::twig;
        texture.blobs = 12;
        texture.coverage = 0.4;
        texture.size = 200;
        texture.seed = seed;
        const OpacityPicture picture = leaf_picture(texture).picture;
        CHECK(count_of_blobs(picture) == 1);
        CHECK(covered_share(picture) > 0.2);
        CHECK(covered_share(picture) < 0.45);
        std::size_t foot = 0;
        for (std::size_t i = 0; i < 200; ++i) {
            const bool is_foot = picture.at(i, 199)[3] > 0;
            foot += is_foot;
            if (is_foot) CHECK(std::abs(double(i) - 100) < 10);
            CHECK(picture.at(i, 0)[3] == 0);
            CHECK(picture.at(0, i)[3] == 0);
            CHECK(picture.at(199, i)[3] == 0);
        }
        CHECK(foot > 0);
    }
    LeafTexture crowded;
    crowded.form = LeafTexture::Form::twig;
    crowded.blobs = 5000;
    crowded.size = 64;
    CHECK_THROWS_WITH(leaf_picture(crowded), Contains("5000 leaves") && Contains("larger --size"));
}
