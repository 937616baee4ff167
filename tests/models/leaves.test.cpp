// Leaves: contours, frameworks, compound leaves. Counts, areas, symmetry.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <span>

using namespace espalier;

namespace {

std::span<const glm::dvec3> vertices_of(const PlantGeometry& geometry, const Polygon& polygon) {
    return std::span(geometry.vertices).subspan(polygon.first, polygon.count);
}

// Area of a plane polygon, by Newell's vector.
double area_of(std::span<const glm::dvec3> vertices) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        sum += glm::cross(vertices[i], vertices[(i + 1) % vertices.size()]);
    return glm::length(sum) / 2;
}

double area_of(const PlantGeometry& geometry) {
    double area = 0;
    for (const Polygon& polygon : geometry.polygons) area += area_of(vertices_of(geometry, polygon));
    return area;
}

// True if every point has a mirror image across x = 0, z = 0.
bool is_symmetric(const std::vector<glm::dvec3>& points, double tolerance) {
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
        return std::any_of(points.begin(), points.end(), [&](const glm::dvec3& q) {
            return glm::distance(glm::dvec3(-p.x, p.y, p.z), q) < tolerance;
        });
    });
}

std::vector<glm::dvec3> tips_of(const PlantGeometry& geometry) {
    std::vector<glm::dvec3> tips;
    for (const Internode& internode : geometry.internodes) tips.push_back(internode.tip);
    return tips;
}

}  // namespace

TEST_CASE("contour-leaf: six vertices that close, in one plane, symmetric to the midrib", "[leaves]") {
    LonePlant leaf("models/leaves/contour-leaf.l");
    const PlantGeometry& geometry = leaf.interpretation.geometry;
    REQUIRE(geometry.polygons.size() == 1);
    const auto vertices = vertices_of(geometry, geometry.polygons[0]);
    REQUIRE(vertices.size() == 6);
    CHECK(glm::distance(vertices.back(), glm::dvec3(0, 0.6, 0)) < 1e-12);
    for (const glm::dvec3& vertex : vertices) CHECK(std::abs(vertex.z) < 1e-12);
    CHECK(is_symmetric({vertices.begin(), vertices.end()}, 1e-12));
    // Two moves at the angle and one along the midrib on each side.
    const double angle = 22.5 * std::numbers::pi / 180;
    CHECK(geometry.bounds.upper.y == Approx(0.6 + 1 + 2 * std::cos(angle)));
    CHECK(area_of(vertices) == Approx(2 * std::sin(angle) * (1 + std::cos(angle))));
}

TEST_CASE("framework-leaf: 6, 24, 44, 66, 90, 116 modules, n(n - 1) segments, 2n polygons, growing area", "[leaves]") {
    LonePlant leaf("models/leaves/framework-leaf.l");
    const std::size_t modules[] = {6, 24, 44, 66, 90, 116};
    const int segments[] = {0, 0, 2, 6, 12, 20, 30};
    double area = 0;
    for (int n = 0; n <= 6; ++n) {
        if (n > 0) leaf.grow(1);
        if (n < 6) CHECK(leaf.string.size() == modules[n]);
        CHECK(leaf.counts()["G"] == segments[n]);
        const PlantGeometry& geometry = leaf.interpretation.geometry;
        CHECK(geometry.polygons.size() == static_cast<std::size_t>(2 * n));
        if (n > 2) CHECK(area_of(geometry) > area);
        area = area_of(geometry);
        CHECK(is_symmetric(geometry.vertices, 1e-9));
    }
}

TEST_CASE("cordate-leaf: without growth it is the framework leaf, with growth it gains area faster", "[leaves]") {
    LonePlant still("models/leaves/cordate-leaf.l", {{"GROWTH", "1"}, {"ANGLE", "9"}});
    LonePlant growing("models/leaves/cordate-leaf.l", {{"ANGLE", "9"}});
    LonePlant framework("models/leaves/framework-leaf.l");
    for (LonePlant* leaf : {&still, &growing, &framework}) leaf->grow(10);
    CHECK(area_of(still.interpretation.geometry) == Approx(area_of(framework.interpretation.geometry)));
    CHECK(area_of(growing.interpretation.geometry) > 1.2 * area_of(still.interpretation.geometry));
    CHECK(is_symmetric(growing.interpretation.geometry.vertices, 1e-9));
}

TEST_CASE("simple-leaf: 2n ribs and one symmetric polygon of 2n + 2 vertices; segments grow by their rate",
          "[leaves]") {
    const double midrib_rate[] = {1.1, 1.2, 1.03};
    for (int shape = 1; shape <= 3; ++shape) {
        LonePlant leaf("models/leaves/simple-leaf.l", {{"SHAPE", std::to_string(shape)}});
        leaf.grow(12);
        CHECK(leaf.counts()["B"] == 24);
        const PlantGeometry& geometry = leaf.interpretation.geometry;
        REQUIRE(geometry.polygons.size() == 1);
        // One at the base, one at every rib's end, one at the tip.
        CHECK(geometry.polygons[0].count == 2 * 12 + 2);
        CHECK(is_symmetric(geometry.vertices, 1e-9));
        std::vector<double> midrib;
        for (const auto& segment : parameters_of(leaf.string, leaf.model->alphabet, "G")) {
            if (segment[1] == midrib_rate[shape - 1] && segment[0] >= 4.9) midrib.push_back(segment[0]);
        }
        REQUIRE(midrib.size() == 12);
        for (std::size_t i = 0; i < midrib.size(); ++i) {
            CHECK(midrib[i] == Approx(5 * std::pow(midrib_rate[shape - 1], 11.0 - static_cast<double>(i))));
        }
    }
}

TEST_CASE("rose-leaf: two polygons a step, halves that mirror each other, teeth that stop growing", "[leaves]") {
    LonePlant leaf("models/leaves/rose-leaf.l");
    for (int n = 1; n <= 20; ++n) {
        leaf.grow(1);
        CHECK(leaf.interpretation.geometry.polygons.size() == static_cast<std::size_t>(2 * n));
    }
    CHECK(is_symmetric(leaf.interpretation.geometry.vertices, 1e-6));
    for (const auto& edge : parameters_of(leaf.string, leaf.model->alphabet, "G")) {
        if (edge.size() != 3) continue;
        CHECK(edge[0] >= 3);
        if (edge[2] <= 1) CHECK(edge[0] <= 3 * std::pow(1.19, 20));
    }
    const auto before = parameters_of(leaf.string, leaf.model->alphabet, "G");
    leaf.grow(1);
    const auto after = parameters_of(leaf.string, leaf.model->alphabet, "G");
    // The first tooth had no time to grow, and never does.
    CHECK(before[1] == after[1]);
}

TEST_CASE("rose-leaf: without fold and bend the leaf is flat, and with them both halves rise alike", "[leaves]") {
    LonePlant flat("models/leaves/rose-leaf.l", {{"FOLD", "0"}, {"BEND", "0"}}), leaf("models/leaves/rose-leaf.l");
    flat.grow(12);
    leaf.grow(12);
    for (const glm::dvec3& vertex : flat.interpretation.geometry.vertices) CHECK(std::abs(vertex.z) < 1e-9);
    const Box& bounds = leaf.interpretation.geometry.bounds;
    CHECK(bounds.upper.z - bounds.lower.z > 0.1 * (bounds.upper.x - bounds.lower.x));
    CHECK(bounds.upper.x == Approx(-bounds.lower.x));
}

TEST_CASE("compound-leaf: apices follow a(n) = a(n-1) + 2 a(n-1-D)", "[leaves]") {
    for (auto [figure, delay] : {std::pair{1, 0}, std::pair{2, 1}, std::pair{3, 2}, std::pair{4, 4}, std::pair{5, 7}}) {
        LonePlant leaf("models/leaves/compound-leaf.l", {{"FIGURE", std::to_string(figure)}});
        // e(n): apices that act in step n; each acts again in the next, and two more D + 1 steps later.
        std::vector<int> acting = {0};
        int segments = 0;
        for (int n = 1; n <= 9; ++n) {
            const int later = n - 1 - delay;
            acting.push_back(n == 1 ? 1
                                    : acting[n - 1u] + (later >= 1 ? 2 * acting[static_cast<std::size_t>(later)] : 0));
            segments += 2 * acting.back();
            leaf.grow(1);
            CHECK(leaf.counts()["F"] == segments);
        }
        int ready = 0;
        for (double wait : values_of(leaf.string, leaf.model->alphabet, "A")) ready += wait == 0 ? 1 : 0;
        const int later = 9 - delay;
        CHECK(ready == acting[9] + (later >= 1 ? 2 * acting[static_cast<std::size_t>(later)] : 0));
    }
}

TEST_CASE("compound-leaf: it is symmetric, and without delay a lateral is as long as the axis above it", "[leaves]") {
    LonePlant leaf("models/leaves/compound-leaf.l", {{"FIGURE", "1"}});
    leaf.grow(6);
    const PlantGeometry& geometry = leaf.interpretation.geometry;
    CHECK(is_symmetric(tips_of(geometry), 1e-9 * geometry.bounds.upper.y));
    // Segments of the main axis before and after the first pair of laterals, and the lateral as a whole.
    double below = 0, above = 0, lateral = 0;
    for (const Internode& internode : geometry.internodes) {
        if (internode.order == 0) (below == 0 ? below : above) += length_of(internode);
        if (internode.axis == 1) lateral += length_of(internode);
    }
    // The axis above holds a segment as old as the one below; the rest repeats the lateral.
    CHECK(above - below == Approx(lateral));
}

TEST_CASE("compound-leaf-alternate: a(n) = a(n-1) + a(n-1-D), laterals left and right in turn", "[leaves]") {
    for (auto [figure, delay] : {std::pair{1, 1}, std::pair{2, 4}, std::pair{3, 7}}) {
        LonePlant leaf("models/leaves/compound-leaf-alternate.l", {{"FIGURE", std::to_string(figure)}});
        std::vector<int> acting = {0};
        int segments = 0;
        for (int n = 1; n <= 14; ++n) {
            const int later = n - 1 - delay;
            acting.push_back(n == 1 ? 1 : acting[n - 1u] + (later >= 1 ? acting[static_cast<std::size_t>(later)] : 0));
            segments += 2 * acting.back();
            leaf.grow(1);
            CHECK(leaf.counts()["F"] == segments);
        }
        // The first module of each branch of the main axis is its turn to the left or to the right.
        std::vector<bool> left;
        const auto symbols = symbols_of(leaf.string, leaf.model->alphabet);
        int depth = 0;
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            if (symbols[i] == "[" && ++depth == 1) left.push_back(symbols[i + 1] == "+");
            if (symbols[i] == "]") --depth;
        }
        REQUIRE(left.size() == 14);
        for (std::size_t i = 1; i < left.size(); ++i) CHECK(left[i] != left[i - 1]);
    }
}

TEST_CASE("fern: the tip is coiled, what is old is straight, and pinnae stand in pairs", "[leaves]") {
    LonePlant frond("models/leaves/fern.l",
                    {{"COIL", "32"}, {"STRAIGHT", "16"}, {"PAIRS", "24"}, {"PINNA_DELAY", "8"}});
    for (int step : {10, 20, 30}) {
        frond.grow(10);
        std::vector<Internode> axis;
        for (const Internode& internode : frond.interpretation.geometry.internodes) {
            if (internode.order == 0) axis.push_back(internode);
        }
        REQUIRE(axis.size() == static_cast<std::size_t>(std::min(step, 24)));
        // The i-th segment is made in step i + 1 with age 0; its angle from the one before vanishes with age.
        for (std::size_t i = 1; i < axis.size(); ++i) {
            const double age = step - 1.0 - static_cast<double>(i);
            const double angle = std::max(0.0, 32 * (1 - age / 16));
            CHECK(degrees_between(direction_of(axis[i - 1]), direction_of(axis[i])) == Approx(angle).margin(1e-6));
        }
    }
    frond.grow(30);
    CHECK(is_symmetric(tips_of(frond.interpretation.geometry), 1e-9));
    CHECK(frond.counts()["["] % 2 == 0);
}

TEST_CASE("compound-leaf-timed: at whole times every segment is as long as in the discrete leaf", "[leaves]") {
    LonePlant timed("models/leaves/compound-leaf-timed.l", {{"DT", "0.1"}}), discrete("models/leaves/compound-leaf.l");
    for (int time = 1; time <= 7; ++time) {
        timed.grow(10);
        discrete.grow(1);
        const Column<Internode>&drawn = timed.interpretation.geometry.internodes,
              &expected = discrete.interpretation.geometry.internodes;
        REQUIRE(drawn.size() == expected.size());
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            CHECK(glm::distance(drawn[i].base, expected[i].base) < 1e-9);
            CHECK(glm::distance(drawn[i].tip, expected[i].tip) < 1e-9);
        }
    }
}

TEST_CASE("compound-leaf-timed: lengths are continuous, and the rate of the main axis is", "[leaves]") {
    constexpr double dt = 0.005;
    LonePlant leaf("models/leaves/compound-leaf-timed.l", {{"DT", "0.005"}, {"D", "0.7"}});
    std::vector<double> whole{0}, main{0};
    for (int step = 1; step <= 1000; ++step) {
        leaf.grow(1);
        whole.push_back(total_length(leaf.interpretation.geometry));
        double axis = 0;
        for (const Internode& internode : leaf.interpretation.geometry.internodes) {
            if (internode.order == 0) axis += length_of(internode);
        }
        main.push_back(axis);
    }
    for (std::size_t i = 2; i < main.size(); ++i) {
        const double rate = (main[i] - main[i - 1]) / dt, before = (main[i - 1] - main[i - 2]) / dt;
        CHECK(std::abs(rate - before) < 0.005 * rate);
        // No length appears at once: the whole changes by what a step of its growth is, 1.5^t times the steps.
        CHECK(whole[i] - whole[i - 1] < 0.015 * whole[i] + 0.01);
        CHECK(whole[i] > whole[i - 1]);
    }
}
