// The curve through points, and its length.
#include "language/pgraph/curve.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier::language::pgraph;

TEST_CASE("A curve passes through its points", "[pgraph]") {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 2, 0}, {1, 2.5, 3}, {-4, 0, 1}};
    const CurveThrough curve(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
        CHECK(glm::distance(curve.at(curve.distance_of(k)), points[k]) < 1e-9);
    }
}

TEST_CASE("Distances along a curve are those of its points in space", "[pgraph]") {
    const CurveThrough straight({{0, 0, 0}, {0, 1, 0}, {0, 5, 0}});
    CHECK(straight.length() == Approx(5).epsilon(1e-9));
    CHECK(glm::distance(straight.at(2.5), glm::dvec3(0, 2.5, 0)) < 1e-9);

    std::vector<glm::dvec3> circle;
    for (int k = 0; k <= 64; ++k) {
        const double angle = 2 * std::numbers::pi * k / 64;
        circle.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    CHECK(CurveThrough(circle).length() == Approx(2 * std::numbers::pi).epsilon(1e-4));

    const CurveThrough bent({{0, 0, 0}, {1, 2, 0}, {1, 2.5, 3}, {-4, 0, 1}});
    double chords = 0;
    for (int k = 0; k < 4000; ++k) {
        chords += glm::distance(bent.at(bent.length() * k / 4000), bent.at(bent.length() * (k + 1) / 4000));
    }
    CHECK(chords == Approx(bent.length()).epsilon(1e-5));
}

TEST_CASE("A curve has one tangent where its pieces meet", "[pgraph]") {
    const CurveThrough curve({{0, 0, 0}, {1, 2, 0}, {1, 2.5, 3}, {-4, 0, 1}});
    for (const std::size_t k : {1, 2}) {
        const double here = curve.distance_of(k), step = 1e-5;
        const glm::dvec3 before = curve.at(here) - curve.at(here - step),
                         after = curve.at(here + step) - curve.at(here);
        CHECK(glm::distance(before, after) < 1e-3 * step);
    }
}
