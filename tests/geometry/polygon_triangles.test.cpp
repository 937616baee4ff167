#include "geometry/polygon_triangles.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::geometry;

namespace {

/// Twice the area of the triangles, all of which turn about `normal`.
double twice_the_area(const std::vector<glm::dvec3>& corners, const EarCut& cut, const glm::dvec3& normal) {
    double sum = 0;
    for (std::size_t i = 0; i < cut.triangles.size(); i += 3) {
        const glm::dvec3 &a = corners[cut.triangles[i]], &b = corners[cut.triangles[i + 1]],
                         &c = corners[cut.triangles[i + 2]];
        const double area = glm::dot(glm::cross(b - a, c - a), normal);
        CHECK(area >= 0);
        sum += area;
    }
    return sum;
}

std::vector<glm::dvec3> star(int points, double inner) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = std::numbers::pi * i / points, radius = i % 2 ? inner : 1;
        corners.push_back({radius * std::cos(angle), 0, radius * std::sin(angle)});
    }
    return corners;
}

const std::vector<glm::dvec3> comb{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}};

}  // namespace

TEST_CASE("the ears of a polygon cover its area", "[geometry]") {
    for (const int points : {3, 5, 12}) {
        const std::vector<glm::dvec3> corners = star(points, 0.4);
        const EarCut cut = cut_ears(corners);
        CHECK(cut.complete);
        CHECK(cut.triangles.size() == 3 * (corners.size() - 2));
        const double area = 2 * points * 0.4 * std::sin(std::numbers::pi / points);
        CHECK(twice_the_area(corners, cut, {0, -1, 0}) == Approx(area).epsilon(1e-12));
    }
}

// What vtkPolygon::Triangulate of VTK 9.1 gives.
TEST_CASE("ears are cut in the order of VTK", "[geometry]") {
    CHECK(cut_ears(comb).triangles == std::vector<std::uint32_t>{0, 1, 6, 4, 5, 3, 2, 3, 1, 5, 6, 3, 1, 3, 6});
    CHECK(cut_ears(star(5, 0.4)).triangles ==
          std::vector<std::uint32_t>{0, 1, 9, 2, 3, 1, 4, 5, 3, 8, 9, 7, 6, 7, 5, 7, 9, 5, 5, 9, 3, 1, 3, 9});
}

TEST_CASE("a corner written twice is one corner", "[geometry]") {
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const EarCut cut = cut_ears(corners);
    CHECK(cut.complete);
    CHECK(twice_the_area(corners, cut, {0, 0, 1}) == Approx(1));
}

TEST_CASE("polygons without an area, or that cross themselves, are not cut whole", "[geometry]") {
    CHECK_FALSE(cut_ears(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}}).complete);
    CHECK_FALSE(cut_ears(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).complete);
    const std::vector<glm::dvec3> crossed{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
    CHECK_FALSE(cut_ears(crossed).complete);
    CHECK(triangles_of(crossed, {0, 0, 1}).empty());
}

TEST_CASE("convex polygons stay whole, concave ones are cut", "[geometry]") {
    CHECK(triangles_of(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 0, 1}).empty());
    CHECK(triangles_of(comb, {0, 0, 1}) == cut_ears(comb).triangles);
}
