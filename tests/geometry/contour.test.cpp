#include "espalier/geometry/contour.h"

#include "espalier/base/error.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::geometry;

namespace {

using Points = std::vector<glm::dvec3>;

const Points diamond{{1, 0, 0}, {0, 2, 0}, {-1, 0, 0}, {0, -2, 0}};

}  // namespace

TEST_CASE("the circle is a regular polygon of radius 1 that begins on the x axis", "[geometry]") {
    const auto vertices = Contour().sample(6);
    REQUIRE(vertices.size() == 7);
    for (int k = 0; k <= 6; ++k) {
        const double angle = k * std::acos(0.5);
        CHECK(glm::distance(vertices[k].position, {std::cos(angle), std::sin(angle), 0}) < 1e-14);
        CHECK(vertices[k].normal == vertices[k].position);
    }
    CHECK(vertices[6].position == vertices[0].position);
    CHECK(Contour().is_circle());
    CHECK(Contour().closed());
    CHECK(Contour().counter_clockwise());
}

TEST_CASE("a closed contour is turned so that its start lies on the x axis, and sampled by arc length", "[geometry]") {
    const auto vertices = Contour(diamond, true).sample(4);
    REQUIRE(vertices.size() == 5);
    // The spline at its start is (P0 + 4 P1 + P2) / 6 = (0, 4/3).
    CHECK(glm::distance(vertices[0].position, {4.0 / 3, 0, 0}) < 1e-12);
    CHECK(glm::distance(vertices[1].position, {0, 2.0 / 3, 0}) < 1e-12);
    CHECK(glm::distance(vertices[2].position, {-4.0 / 3, 0, 0}) < 1e-12);
    CHECK(glm::distance(vertices[3].position, {0, -2.0 / 3, 0}) < 1e-12);
    CHECK(vertices[4].position == vertices[0].position);
}

TEST_CASE("normals point out of closed contours, whichever way they go round", "[geometry]") {
    for (const bool reversed : {false, true}) {
        Points points = diamond;
        if (reversed) std::swap(points[1], points[3]);
        const Contour contour(points, true);
        CHECK(contour.counter_clockwise() == !reversed);
        for (const Contour::Vertex& vertex : contour.sample(16)) {
            CHECK(glm::dot(vertex.normal, vertex.position) > 0.4);
            CHECK(glm::length(vertex.normal) == Approx(1));
        }
    }
}

TEST_CASE("an open contour is not turned and goes from its end to its end", "[geometry]") {
    const auto vertices = Contour({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, false).sample(4);
    REQUIRE(vertices.size() == 5);
    // On a straight line with points one apart the spline is uniform from 1 to 3.
    for (int k = 0; k <= 4; ++k) CHECK(vertices[k].position.x == Approx(1 + 0.5 * k));
    CHECK(vertices[1].normal == glm::dvec3(0, -1, 0));  // the direction turned by -90 degrees
    CHECK_FALSE(Contour({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, false).closed());
}

TEST_CASE("equal distances along the curve are equal to the accuracy of its chords", "[geometry]") {
    const auto vertices = Contour({{3, 0, 0}, {0, 1, 0}, {-3, 0, 0}, {0, -1, 0}}, true).sample(200);
    double shortest = 1e9, longest = 0;
    for (std::size_t k = 1; k < vertices.size(); ++k) {
        const double chord = glm::distance(vertices[k].position, vertices[k - 1].position);
        shortest = std::min(shortest, chord);
        longest = std::max(longest, chord);
    }
    CHECK(longest / shortest < 1.05);
}

TEST_CASE("a repeated point makes a corner the curve goes through", "[geometry]") {
    const Contour contour({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, true);
    double nearest = 1e9;
    for (const auto& vertex : contour.sample(100)) {
        nearest = std::min(nearest, std::abs(glm::length(vertex.position) - std::sqrt(2)));
    }
    CHECK(nearest < 0.01);
}

TEST_CASE("at a corner the normal lies between those of its sides", "[geometry]") {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3 corner :
         {glm::dvec3(2, 0, 0), glm::dvec3(0, 2, 0), glm::dvec3(-2, 0, 0), glm::dvec3(0, -2, 0)}) {
        points.insert(points.end(), 3, corner);
    }
    // The curve begins at its first corner, which is its own place on the x axis.
    const auto vertices = Contour(points, true).sample(16);
    for (int corner = 0; corner < 4; ++corner) {
        const Contour::Vertex& vertex = vertices[4 * corner];
        CHECK(glm::length(vertex.position) == Approx(2));
        CHECK(glm::distance(vertex.normal, glm::normalize(vertex.position)) < 1e-6);
    }
}

TEST_CASE("a contour of too few points is refused, one whose points coincide is not", "[geometry]") {
    CHECK_THROWS_AS(Contour({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, false), UserError);
    CHECK_THROWS_AS(Contour({{0, 0, 0}, {1, 0, 0}}, true), UserError);
    for (const auto& vertex : Contour(Points(4), true).sample(5)) CHECK(glm::length(vertex.normal) == 1);
}
