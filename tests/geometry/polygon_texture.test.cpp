#include "geometry/polygon_texture.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <vector>

using namespace espalier;
using namespace espalier::geometry;

namespace {

void check_uvs(const std::vector<glm::dvec3>& corners, const std::vector<glm::dvec2>& expected) {
    const std::vector<glm::dvec2> uvs = texture_coordinates(corners, {0, 0, 1});
    REQUIRE(uvs.size() == expected.size());
    for (std::size_t i = 0; i < uvs.size(); ++i) CHECK(glm::distance(uvs[i], expected[i]) < 1e-9);
}

}  // namespace

TEST_CASE("a picture runs along a leaf from its foot to its tip", "[geometry]") {
    check_uvs({{0, 0, 0}, {1, 2, 0}, {0, 4, 0}, {-1, 2, 0}}, {{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}});
    // The same leaf upside down: the foot is still where the picture begins.
    check_uvs({{0, 4, 0}, {-1, 2, 0}, {0, 0, 0}, {1, 2, 0}}, {{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}});
}

TEST_CASE("a picture fills a rectangle along its longer side, and a square along its first edge", "[geometry]") {
    check_uvs({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, {{1, 0}, {1, 1}, {0, 1}, {0, 0}});
    check_uvs({{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}}, {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
}

TEST_CASE("a polygon without area has no place for a picture", "[geometry]") {
    check_uvs({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0}, {0, 0}, {0, 0}});
}
