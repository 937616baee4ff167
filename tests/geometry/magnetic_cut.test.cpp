// Cross-sections that magnets pull out and push in.
#include "geometry/magnetic_cut.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::geometry;

namespace {

using std::numbers::pi;

double area(const std::vector<Contour::Vertex>& vertices) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
        const glm::dvec3 &p = vertices[k].position, &q = vertices[k + 1].position;
        sum += (p.x * q.y - p.y * q.x) / 2;
    }
    return sum;
}

double radius(const Contour::Vertex& vertex) {
    return glm::length(vertex.position);
}

}  // namespace

TEST_CASE("without magnets, or with magnets of no strength, the cut is an ellipse", "[geometry]") {
    for (const std::vector<double>& strengths : {std::vector<double>{}, std::vector<double>{0, 0, 0, 0, 0}}) {
        const auto vertices = MagneticCut{0.4, strengths, false}.sample(64);
        REQUIRE(vertices.size() == 65);
        for (const Contour::Vertex& vertex : vertices) {
            CHECK(std::hypot(vertex.position.x / 0.4, vertex.position.y) == Approx(1));
        }
        CHECK(vertices.back().position == vertices.front().position);
        const double polygon = 64 / 2.0 * std::sin(2 * pi / 64) * 0.4;
        CHECK(area(vertices) == Approx(polygon));
        CHECK(area(MagneticCut{0.4, strengths, false}.sample(1000)) == Approx(pi * 0.4).epsilon(1e-4));
    }
    const auto circle = Contour().sample(12), cut = Contour(MagneticCut{}).sample(12);
    for (std::size_t k = 0; k < circle.size(); ++k) {
        CHECK(glm::distance(circle[k].position, cut[k].position) < 1e-12);
        CHECK(glm::distance(circle[k].normal, cut[k].normal) < 1e-12);
    }
}

TEST_CASE("at a magnet the outline has gone out by its strength in radii", "[geometry]") {
    const auto vertices = MagneticCut{1, {0.5, 0, -0.25, 1}, false}.sample(4);
    CHECK(radius(vertices[0]) == Approx(1.5));
    CHECK(vertices[0].position.x == Approx(1.5));  // above
    CHECK(vertices[1].position.y == Approx(1));    // to the right
    CHECK(radius(vertices[2]) == Approx(0.75));
    CHECK(radius(vertices[3]) == Approx(2));
}

TEST_CASE("a stronger magnet pulls the outline out, and nowhere beyond it", "[geometry]") {
    double before = 0;
    for (const double strength : {-1.0, -0.5, -0.1, 0.0, 0.2, 1.0, 3.0}) {
        const auto vertices = MagneticCut{1, {0, 0, strength, 0, 0, 0}, false}.sample(60);
        CHECK(radius(vertices[20]) >= before);
        before = radius(vertices[20]);
        for (const Contour::Vertex& vertex : vertices) {
            CHECK(radius(vertex) <= std::max(1.0, 1 + strength) + 1e-12);
            CHECK(radius(vertex) >= std::min(1.0, 1 + strength) - 1e-12);
        }
    }
}

TEST_CASE("symmetric magnets make a symmetric cut", "[geometry]") {
    const auto vertices = MagneticCut{0.7, {0.3, -0.2, 0.5, -0.2}, false}.sample(24);
    for (std::size_t k = 0; k <= 24; ++k) {
        const glm::dvec3 &p = vertices[k].position, &q = vertices[24 - k].position;
        CHECK(p.x == Approx(q.x).margin(1e-12));
        CHECK(p.y == Approx(-q.y).margin(1e-12));
    }
}

TEST_CASE("an outline never crosses itself: it goes round the middle once, at a radius of 0 or more", "[geometry]") {
    const auto vertices = MagneticCut{1, {5, -1, -7, 0.3, 2, -1, 4}, false}.sample(210);
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
        const glm::dvec3 &p = vertices[k].position, &q = vertices[k + 1].position;
        CHECK(p.x * q.y - p.y * q.x >= -1e-12);
    }
}

TEST_CASE("more magnets bring the cut nearer to a shape", "[geometry]") {
    const auto wanted = [](double angle) { return 1 + 0.3 * std::cos(2 * angle) + 0.2 * std::sin(3 * angle); };
    double before = 10;
    for (const int magnets : {4, 8, 16, 32}) {
        std::vector<double> strengths;
        for (int k = 0; k < magnets; ++k) strengths.push_back(wanted(2 * pi * k / magnets) - 1);
        const auto vertices = MagneticCut{1, strengths, false}.sample(720);
        double error = 0;
        for (int k = 0; k < 720; ++k) error = std::max(error, std::abs(radius(vertices[k]) - wanted(2 * pi * k / 720)));
        CHECK(error < 0.7 * before);
        before = error;
    }
    CHECK(before < 0.01);
}

TEST_CASE("a flat cut is the line half-way between the two sides of the outline", "[geometry]") {
    const auto straight = MagneticCut{0.5, {0.2, 0.1, 0.2, 0.4}, true}.sample(8);
    REQUIRE(straight.size() == 9);
    CHECK(straight.front().position.y == Approx(-1.4));
    CHECK(straight.back().position.y == Approx(1.1));
    for (const Contour::Vertex& vertex : straight) {
        CHECK(vertex.position.x == Approx(0).margin(1e-12));  // the same magnets above and below
        CHECK(vertex.normal.x == Approx(1));
    }
    const auto folded = MagneticCut{0.5, {0.6, 0, 0, 0}, true}.sample(8);
    CHECK(folded[4].position.x == Approx(0.15));  // the magnet above lifts the middle
    CHECK(folded[0].position.x == Approx(0).margin(1e-12));
    CHECK_FALSE(Contour(MagneticCut{1, {}, true}).closed());
    CHECK_FALSE(Contour(MagneticCut{1, {}, true}).is_circle());
}
