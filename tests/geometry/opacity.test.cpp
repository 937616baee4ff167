// How much of a face its picture leaves opaque.
#include "geometry/opacity.h"

#include "base/png_file.h"
#include "catch.h"
#include "geometry/drawn/faces.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

using namespace espalier;
using Corners = std::vector<glm::dvec2>;

namespace {

/// Four columns and two rows of pixels; the upper row is clear but for its last pixel.
const Opacity& sampler() {
    static const Opacity opacity(4, 2, {255, 255, 0, 51, 0, 0, 0, 255});
    return opacity;
}

/// A picture of `side` pixels whose left part is clear.
std::filesystem::path half_clear(const TemporaryFolder& folder, const std::string& name, std::size_t clear,
                                 std::size_t side = 10) {
    OpacityPicture picture{side, side, {}};
    for (std::size_t i = 0; i < side * side; ++i) {
        picture.pixels.push_back({200, 200, 200, static_cast<std::uint8_t>(i % side < clear ? 0 : 255)});
    }
    return folder.write(name, png_bytes(picture));
}

/// Squares of side 1 that stand on the origin, each across another direction.
Surface squares(const std::vector<glm::dvec3>& directions) {
    Surface surface;
    surface.precision_s = surface.precision_t = 1;
    for (const glm::dvec3& across : directions) {
        BicubicPatch& patch = surface.patches.emplace_back();
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t column = 0; column < 4; ++column) {
                patch.points[row][column] = (double(row) / 3 - 0.5) * across + glm::dvec3(0, double(column) / 3, 0);
            }
        }
    }
    return surface;
}

}  // namespace

TEST_CASE("opacity over boxes of pixels is their mean, also where the picture repeats", "[geometry]") {
    const auto box = [](double left, double low, double right, double high) {
        return sampler().over(Corners{{left, low}, {right, low}, {right, high}, {left, high}});
    };
    CHECK(box(0, 0, 1, 1) == Approx((255 + 255 + 51 + 255) / 255. / 8));
    CHECK(box(0, 0, 0.5, 0.5) == Approx(1));
    CHECK(box(0.5, 0, 1, 0.5) == Approx(0.1));
    CHECK(box(0.125, 0, 0.625, 0.5) == Approx(0.75));
    CHECK(box(-1, -2, 1, 1) == Approx(box(0, 0, 1, 1)));
    CHECK(box(0.75, 0, 1.25, 1) == Approx((0.2 + 1 + 1 + 0) / 4));
    CHECK(sampler().over(Corners{{1, 1}, {0, 1}, {0, 0}, {1, 0}}) == Approx(box(0, 0, 1, 1)));  // mirrored
}

TEST_CASE("opacity over other polygons is within a hundredth of the area that they share with pixels", "[geometry]") {
    double slow = 0;
    constexpr int fine = 1000;
    for (int i = 0; i < fine; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double u = (i + 0.5) / fine, v = (j + 0.5) / fine;
            const std::array<double, 8> pixels{1, 1, 0, 0.2, 0, 0, 0, 1};
            slow += (i == j ? 0.5 : 1) * pixels[static_cast<std::size_t>(4 * u) + 4 * static_cast<std::size_t>(2 * v)];
        }
    }
    CHECK(sampler().over(Corners{{0, 0}, {1, 0}, {1, 1}}) == Approx(slow / (fine * fine / 2.)).margin(0.01));
    CHECK(sampler().over(Corners{{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}}) == Approx(816 / 255. / 8));  // without area
}

TEST_CASE("files without holes, or that are no PNG, are opaque; a file that changes is read anew", "[geometry]") {
    const TemporaryFolder folder;
    CHECK_FALSE(Opacity::of(folder.path() / "missing.png"));
    CHECK_FALSE(Opacity::of(folder.write("text.png", "no picture")));
    CHECK_FALSE(Opacity::of(half_clear(folder, "whole.png", 0)));
    const auto file = half_clear(folder, "half.png", 5);
    const Corners whole{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    REQUIRE(Opacity::of(file));
    CHECK(Opacity::of(file)->over(whole) == Approx(0.5));
    CHECK(Opacity::of(file) == Opacity::of(file));
    half_clear(folder, "half.png", 8);
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(2));
    CHECK(Opacity::of(file)->over(whole) == Approx(0.2));
}

TEST_CASE("light meets of a card what its picture leaves opaque, and a card that shows nothing not at all",
          "[geometry]") {
    const TemporaryFolder folder;
    const auto area_of = [&](const std::filesystem::path& picture, const Surface& surface) {
        auto shapes = std::make_shared<Shapes>();
        shapes->surfaces['l'] = surface;
        shapes->textures.push_back({picture});
        PlantGeometry geometry;
        geometry.shapes = shapes;
        Organ& organ = geometry.organs.emplace_back();
        organ.shape = Organ::Shape::surface;
        organ.surface = 'l';
        organ.size = {2, 2, 2};
        organ.pose.position = {3, 4, 5};
        organ.look.texture = 1;
        DrawnFaces faces;
        faces.add_leaves(0, geometry);
        double area = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            area += glm::length(faces[i].area());
            CHECK(glm::distance(faces[i].middle(), glm::dvec3(3, 5, 5)) < 1e-12);  // it stays where it was
        }
        return area;
    };
    const Surface card = squares({{1, 0, 0}}), cross = squares({{1, 0, 0}, {0, 0, 1}});
    CHECK(area_of(half_clear(folder, "a.png", 0), card) == Approx(4));
    CHECK(area_of(half_clear(folder, "b.png", 7), card) == Approx(0.3 * 4));
    CHECK(area_of(half_clear(folder, "b.png", 7), cross) == Approx(0.3 * 8));
    CHECK(area_of(half_clear(folder, "c.png", 10), cross) == 0);
}
