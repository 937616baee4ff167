// models/curves: strings as printed, numbers of segments, ends, areas, and cells visited once.
#include "catch.h"
#include "experiments/growth.h"
#include "models/paths.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

using namespace espalier;

namespace {

int power(int base, int exponent) {
    int result = 1;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
}

/// Distance of the curve's end from its beginning.
double span(const PlantGeometry& geometry) {
    return glm::length(geometry.internodes.back().tip - geometry.internodes.front().base);
}

/// A closed outline of 4 * factor^steps sides around area_per_step^steps unit squares, which touches itself nowhere.
void check_island(const std::string& file, int steps, int factor, double area_per_step) {
    LonePlant island(file);
    island.grow(steps);
    const std::vector<glm::dvec3> points = corners(island.interpretation.geometry);
    CHECK(points.size() == static_cast<std::size_t>(4 * power(factor, steps)) + 1);
    CHECK(span(island.interpretation.geometry) == Approx(0).margin(1e-6));
    CHECK(distinct(points).size() == points.size() - 1);
    CHECK(enclosed_area(points) == Approx(std::pow(area_per_step, steps)));
}

}  // namespace

TEST_CASE("Koch: one and two steps give the printed strings", "[curves]") {
    LonePlant curve("models/curves/koch.l");
    CHECK(curve.text() == "F");
    curve.grow(1);
    CHECK(curve.text() == "F+F--F+F");
    curve.grow(1);
    CHECK(curve.text() == "F+F--F+F+F+F--F+F--F+F--F+F+F+F--F+F");
}

TEST_CASE("Koch: 4^n segments, (4/3)^n long for the base line, which the curve begins and ends on", "[curves]") {
    LonePlant curve("models/curves/koch.l");
    for (int n = 1; n <= 5; ++n) {
        curve.grow(1);
        const PlantGeometry& geometry = curve.interpretation.geometry;
        CHECK(geometry.internodes.size() == static_cast<std::size_t>(power(4, n)));
        const glm::dvec3 end = geometry.internodes.back().tip;
        CHECK(end.y == Approx(power(3, n)));
        CHECK(std::abs(end.x) < 1e-9);
        CHECK(total_length(geometry) / end.y == Approx(std::pow(4.0 / 3.0, n)));
    }
}

TEST_CASE("Koch's snowflake: its area tends to 8/5 of the triangle's, its outline grows by 4/3", "[curves]") {
    LonePlant flake("models/curves/koch-snowflake.l");
    const double triangle = std::sqrt(3.0) / 4;
    for (int n = 1; n <= 5; ++n) {
        flake.grow(1);
        const PlantGeometry& geometry = flake.interpretation.geometry;
        CHECK(geometry.internodes.size() == static_cast<std::size_t>(3 * power(4, n)));
        CHECK(span(geometry) == Approx(0).margin(1e-6));
        const double scaled = enclosed_area(corners(geometry)) / std::pow(9.0, n);
        CHECK(scaled == Approx(triangle * (8 - 3 * std::pow(4.0 / 9.0, n)) / 5));
        REQUIRE(geometry.polygons.size() == 1);
        CHECK(enclosed_area(geometry.vertices) == Approx(scaled * std::pow(9.0, n)));
    }
}

TEST_CASE("Koch's curve with gaps: 3^n segments, all of them the curve's", "[curves]") {
    LonePlant dust("models/curves/koch-gaps.l"), curve("models/curves/koch.l");
    for (int n = 1; n <= 5; ++n) {
        dust.grow(1);
        curve.grow(1);
        const auto drawn = edges(dust.interpretation.geometry), whole = edges(curve.interpretation.geometry);
        CHECK(drawn.size() == static_cast<std::size_t>(power(3, n)));
        CHECK(std::includes(whole.begin(), whole.end(), drawn.begin(), drawn.end()));
        CHECK(dust.interpretation.geometry.internodes.back().tip.y == Approx(power(3, n)));
    }
}

TEST_CASE("Quadratic Koch islands keep the area of the square they began with", "[curves]") {
    for (int n = 1; n <= 4; ++n) {
        check_island("models/curves/quadratic-island.l", n, 8, 16);
    }
    for (int n = 1; n <= 3; ++n) {
        check_island("models/curves/quadratic-island-18.l", n, 18, 36);
    }
}

TEST_CASE("Quadratic snowflake: 5^n segments end 3^n ahead and stay on one side of the base line", "[curves]") {
    LonePlant flake("models/curves/quadratic-snowflake.l");
    for (int n = 1; n <= 5; ++n) {
        flake.grow(1);
        const std::vector<glm::dvec3> points = corners(flake.interpretation.geometry);
        CHECK(points.size() == static_cast<std::size_t>(power(5, n)) + 1);
        CHECK(points.back().x == Approx(power(3, n)));
        CHECK(std::abs(points.back().y) < 1e-6);
        for (const glm::dvec3& point : points) CHECK(point.y > -1e-6);
    }
}

TEST_CASE("Islands and lakes: 18 segments for each, and the turtle comes back to where it began", "[curves]") {
    LonePlant map("models/curves/islands-and-lakes.l");
    for (int n = 1; n <= 3; ++n) {
        map.grow(1);
        CHECK(map.counts()["F"] == 4 * power(18, n));
        CHECK(map.counts()["f"] == 4 * (4 * (power(18, n) - power(6, n)) / 12));
        CHECK(span(map.interpretation.geometry) == Approx(0).margin(1e-6));
    }
}

TEST_CASE("Variations on the Koch construction: as many segments as their productions say", "[curves]") {
    const int segments[] = {8, 7, 7, 5, 5, 5};
    for (int variation = 1; variation <= 6; ++variation) {
        LonePlant island("models/curves/koch-variations.l", {{"VARIATION", std::to_string(variation)}});
        for (int n = 1; n <= 4; ++n) {
            island.grow(1);
            CHECK(island.counts()["F"] == 4 * power(segments[variation - 1], n));
        }
        CHECK(span(island.interpretation.geometry) == Approx(0).margin(1e-6));
    }
}

TEST_CASE("Dragon curve: bends of folded paper, and no edge is passed twice", "[curves]") {
    LonePlant dragon("models/curves/dragon.l");
    dragon.grow(11);
    const PlantGeometry& geometry = dragon.interpretation.geometry;
    REQUIRE(geometry.internodes.size() == 2048);
    CHECK(edges(geometry).size() == 2048);
    for (unsigned k = 1; k < 2048; ++k) {
        const Internode &before = geometry.internodes[k - 1], &after = geometry.internodes[k];
        const double bend = glm::cross(before.tip - before.base, after.tip - after.base).z;
        unsigned odd = k;
        while (odd % 2 == 0) odd /= 2;
        CHECK(bend == Approx(odd % 4 == 1 ? 1 : -1));
    }
}

TEST_CASE("Levy's C curve: 2^n segments, the span grows by the square root of 2", "[curves]") {
    LonePlant curve("models/curves/levy.l");
    for (int n = 1; n <= 12; ++n) {
        curve.grow(1);
        CHECK(curve.interpretation.geometry.internodes.size() == static_cast<std::size_t>(power(2, n)));
        CHECK(span(curve.interpretation.geometry) == Approx(std::pow(2, n / 2.0)));
        CHECK(std::abs(curve.interpretation.geometry.internodes.back().tip.x) < 1e-6);
    }
}

TEST_CASE("Sierpinski's and Gosper's curves pass no point twice and span 2^n and sqrt(7)^n", "[curves]") {
    LonePlant arrowhead("models/curves/sierpinski.l"), island("models/curves/gosper.l");
    for (int n = 1; n <= 5; ++n) {
        arrowhead.grow(1);
        island.grow(1);
        const std::vector<glm::dvec3> a = corners(arrowhead.interpretation.geometry);
        const std::vector<glm::dvec3> b = corners(island.interpretation.geometry);
        CHECK(a.size() == static_cast<std::size_t>(power(3, n)) + 1);
        CHECK(distinct(a).size() == a.size());
        CHECK(span(arrowhead.interpretation.geometry) == Approx(power(2, n)));
        CHECK(b.size() == static_cast<std::size_t>(power(7, n)) + 1);
        CHECK(distinct(b).size() == b.size());
        CHECK(span(island.interpretation.geometry) == Approx(std::pow(7, n / 2.0)));
    }
}

TEST_CASE("Quadratic Gosper curve: 25^n segments in a square of side 5^n, no point twice", "[curves]") {
    LonePlant curve("models/curves/quadratic-gosper.l");
    for (int n = 1; n <= 3; ++n) {
        curve.grow(1);
        const std::vector<glm::dvec3> points = corners(curve.interpretation.geometry);
        CHECK(points.size() == static_cast<std::size_t>(power(25, n)) + 1);
        CHECK(distinct(points).size() == points.size());
        const glm::dvec3 size = extent(points);
        CHECK(size.x == Approx(power(5, n)));
        CHECK(size.y <= power(5, n) + 1e-6);
    }
}

TEST_CASE("Space-filling curves visit each cell of a square or cube once", "[curves]") {
    struct Curve {
        const char* file;
        int side, dimensions, steps;
    };
    for (const Curve& curve : {Curve{"hilbert.l", 2, 2, 6}, Curve{"peano.l", 3, 2, 4}, Curve{"macrotile.l", 3, 2, 4},
                               Curve{"hilbert-3d.l", 2, 3, 4}}) {
        INFO(curve.file);
        LonePlant line(std::string("models/curves/") + curve.file);
        for (int n = 1; n <= curve.steps; ++n) {
            line.grow(1);
            CHECK(visits_each_cell_once(line.interpretation.geometry, power(curve.side, n), curve.dimensions));
        }
    }
}

TEST_CASE("Moore's curve is a tour: each cell once, and the last is beside the first", "[curves]") {
    LonePlant tour("models/curves/moore.l");
    for (int n = 1; n <= 5; ++n) {
        tour.grow(1);
        CHECK(visits_each_cell_once(tour.interpretation.geometry, power(2, n + 1), 2));
        CHECK(span(tour.interpretation.geometry) == Approx(1));
    }
}

TEST_CASE("Penrose's tiling: unit edges along multiples of 36 degrees, the same after a fifth of a turn", "[curves]") {
    LonePlant tiling("models/curves/penrose.l");
    tiling.grow(4);
    const PlantGeometry& geometry = tiling.interpretation.geometry;
    REQUIRE(geometry.internodes.size() == 1780);
    std::set<PointKey> points;
    for (const Internode& edge : geometry.internodes) {
        const glm::dvec3 step = edge.tip - edge.base;
        CHECK(glm::length(step) == Approx(1));
        const double turns = std::atan2(step.x, step.y) / (std::numbers::pi / 5);
        CHECK(std::abs(turns - std::round(turns)) < 1e-9);
        points.insert(key(edge.base));
        points.insert(key(edge.tip));
    }
    // Rounded keys may differ in the last place after a turn: look at the neighbours too.
    const std::complex<double> fifth = std::polar(1.0, 2 * std::numbers::pi / 5);
    for (const PointKey& point : points) {
        const std::complex<double> turned =
            fifth * std::complex<double>(static_cast<double>(point[0]), static_cast<double>(point[1]));
        bool found = false;
        for (long long dx = -1; dx <= 1; ++dx) {
            for (long long dy = -1; dy <= 1; ++dy) {
                found |= points.contains({std::llround(turned.real()) + dx, std::llround(turned.imag()) + dy, 0});
            }
        }
        CHECK(found);
    }
}

TEST_CASE("Row of trees: parts divide when their waiting is over; with right angles it ends 1 ahead on its base line",
          "[curves]") {
    struct Part {
        double length;
        int wait;
    };
    const double p = 0.3, height = std::sqrt(p * (1 - p));
    std::vector<Part> parts{{1, 0}};
    LonePlant row("models/curves/row-of-trees.l", {{"ANGLE", "90"}});
    for (int step = 1; step <= 10; ++step) {
        std::vector<Part> next;
        for (const Part& part : parts) {
            if (part.wait > 0) {
                next.push_back({part.length, part.wait - 1});
            } else {
                for (const auto& [factor, wait] : {Part{p, 2}, Part{height, 1}, Part{height, 1}, Part{1 - p, 0}}) {
                    next.push_back({part.length * factor, wait});
                }
            }
        }
        parts = next;
        row.grow(1);
        const PlantGeometry& geometry = row.interpretation.geometry;
        REQUIRE(geometry.internodes.size() == parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            CHECK(glm::length(geometry.internodes[i].tip - geometry.internodes[i].base) == Approx(parts[i].length));
        }
        CHECK(geometry.internodes.back().tip.x == Approx(1));
        CHECK(std::abs(geometry.internodes.back().tip.y) < 1e-9);
    }
}
