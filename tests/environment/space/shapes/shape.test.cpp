#include "espalier/environment/shape.h"

#include "base/parallel.h"
#include "catch.h"
#include "environment/space/shapes/tables.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace espalier;
using namespace espalier::environment;

namespace {

const char* const simple_solids[] = {
    "shape = 'box'\nlower = [-1, -0.5, -2]\nupper = [0.5, 1.5, 1]",
    "shape = 'sphere'\ncenter = [0.2, -0.1, 0.3]\nradius = 1.1",
    "shape = 'ellipsoid'\ncenter = [0.1, 0.2, -0.3]\nradii = [0.5, 2, 1]",
    "shape = 'cylinder'\nbase = [-1, -1, -1]\ntip = [0.5, 1, 1.5]\nradius = 0.7",
    "shape = 'cone'\nbase = [0.3, -1.5, 0]\ntip = [0, 1.5, 0.5]\nbase_radius = 1.2\ntip_radius = 0.3",
    "shape = 'cone'\nbase = [0, 1, 0]\ntip = [0, -1, 0]\nbase_radius = 1",
    "shape = 'tube'\npoints = [[-1, 0, 0], [1, 0, 0]]\nradius = 0.4",
    "shape = 'half-space'\npoint = [0, 0.5, 0]\nnormal = [1, 2, 3]",
    "shape = 'box'\ncenter = [0, 0, 0]\nsize = [1, 2, 3]\nscale = 0.7\n"
    "rotate = { axis = [1, 1, 0], angle = 33 }\ntranslate = [0.3, 0, 0.1]",
    "shape = 'height-field'\nheights = [0, 1, 0.5, 0.2, 0.7, 0.9]\ncolumns = 3\nsize = [2, 1.5]\ncorner = [-1, 0, -1]",
};

const char* const compounds[] = {
    "shape = 'union'\nof = [{ shape = 'sphere', center = [0, 0, 0], radius = 1 },"
    " { shape = 'box', lower = [0, 0, 0], upper = [2, 1, 1] }]",
    "shape = 'union'\nblend = 0.5\nof = [{ shape = 'sphere', center = [-0.8, 0, 0], radius = 1 },"
    " { shape = 'sphere', center = [0.8, 0, 0], radius = 1 }]",
    "shape = 'intersection'\nof = [{ shape = 'sphere', center = [0, 0, 0], radius = 1.5 },"
    " { shape = 'half-space', normal = [0, 1, 0] }]",
    "shape = 'difference'\nof = [{ shape = 'box', center = [0, 0, 0], size = [3, 3, 3] },"
    " { shape = 'sphere', center = [0, 1.5, 0], radius = 1 }, { shape = 'sphere', center = [1.5, 0, 0], radius = 1 }]",
    "shape = 'tube'\npoints = [[-1, 0, 0], [0, 1, 0], [1, 0, 0.5]]\nradius = 0.4",
    "shape = 'box'\ncenter = [0, 0, 0]\nsize = [1, 2, 3]\noffset = 0.25",
};

void for_each_solid(const std::function<void(const Shape&)>& claim) {
    for (const char* toml : simple_solids) {
        INFO(toml);
        claim(*shape_of(toml));
    }
    for (const char* toml : compounds) {
        INFO(toml);
        claim(*shape_of(toml));
    }
}

/// The largest difference between a shape's distance and a closed form.
double largest_error(const char* toml, const std::function<double(const glm::dvec3&)>& closed_form) {
    const auto shape = shape_of(toml);
    double largest = 0;
    for (const glm::dvec3& point : random_points(10000, 3)) {
        largest = std::max(largest, std::abs(shape->distance(point) - closed_form(point)));
    }
    return largest;
}

/// The distance to a sampled ellipsoid surface, refined around the nearest sample until it stands still.
double brute_force_distance(const glm::dvec3& point, const glm::dvec3& radii) {
    double best = std::numeric_limits<double>::infinity(), best_u = 0, best_v = 0;
    double u_from = 0, u_to = glm::radians(180.0), v_from = 0, v_to = glm::radians(360.0);
    for (int round = 0; round < 40; ++round) {
        for (int i = 0; i <= 40; ++i) {
            for (int j = 0; j <= 40; ++j) {
                const double u = glm::mix(u_from, u_to, i / 40.0), v = glm::mix(v_from, v_to, j / 40.0);
                const glm::dvec3 on =
                    radii * glm::dvec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u));
                if (const double away = glm::length(point - on); away < best) {
                    best = away;
                    best_u = u;
                    best_v = v;
                }
            }
        }
        const double u_reach = 0.25 * (u_to - u_from), v_reach = 0.25 * (v_to - v_from);
        u_from = best_u - u_reach;
        u_to = best_u + u_reach;
        v_from = best_v - v_reach;
        v_to = best_v + v_reach;
    }
    return best;
}

}  // namespace

TEST_CASE("distances of simple solids equal their closed forms", "[shape]") {
    CHECK(largest_error("shape = 'sphere'\ncenter = [0, 1, 0]\nradius = 0.5",
                        [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0, 1, 0)) - 0.5; }) < 1e-12);
    CHECK(largest_error("shape = 'box'\ncenter = [0, 0, 1]\nsize = [1, 2, 4]", [](const glm::dvec3& p) {
              const glm::dvec3 q = glm::abs(p - glm::dvec3(0, 0, 1)) - glm::dvec3(0.5, 1, 2);
              return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
          }) < 1e-12);
    CHECK(largest_error("shape = 'half-space'\npoint = [0, -1, 0]\nnormal = [0, 5, 0]",
                        [](const glm::dvec3& p) { return p.y + 1; }) < 1e-12);
    CHECK(
        largest_error("shape = 'cylinder'\nbase = [0, -1, 0]\ntip = [0, 2, 0]\nradius = 0.8", [](const glm::dvec3& p) {
            const double across = std::hypot(p.x, p.z) - 0.8, along = std::abs(p.y - 0.5) - 1.5;
            return std::hypot(std::max(across, 0.0), std::max(along, 0.0)) + std::min(std::max(across, along), 0.0);
        }) < 1e-12);
    CHECK(largest_error("shape = 'tube'\npoints = [[0, -1, 0], [0, 1, 0]]\nradius = 0.3", [](const glm::dvec3& p) {
              return std::hypot(p.x, p.y - std::clamp(p.y, -1.0, 1.0), p.z) - 0.3;
          }) < 1e-12);
    CHECK(largest_error("shape = 'ellipsoid'\ncenter = [1, 0, 0]\nradii = [0.7, 0.7, 0.7]",
                        [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(1, 0, 0)) - 0.7; }) < 1e-12);
}

TEST_CASE("the inside of a cone is as far from its side as trigonometry says", "[shape]") {
    // Half angle 45 degrees: from the axis at height h below the tip the side is h / sqrt(2) away.
    const auto cone = shape_of("shape = 'cone'\nbase = [0, 0, 0]\ntip = [0, 10, 0]\nbase_radius = 10");
    CHECK(cone->distance({0, 9, 0}) == Approx(-std::sqrt(0.5)).epsilon(1e-12));
    CHECK(cone->distance({0, 1, 0}) == Approx(-1).epsilon(1e-12));  // the base is nearer
    CHECK(cone->distance({0, 12, 0}) == Approx(2).epsilon(1e-12));
    CHECK(cone->distance({10, 10, 0}) == Approx(10 * std::sqrt(0.5)).epsilon(1e-12));
}

TEST_CASE("the nearest point of an ellipsoid is the one a search finds", "[shape]") {
    const glm::dvec3 radii(0.5, 2, 1);
    const auto ellipsoid = shape_of("shape = 'ellipsoid'\ncenter = [0, 0, 0]\nradii = [0.5, 2, 1]");
    std::vector<glm::dvec3> points = random_points(60, 2.5);
    // Centre, axes and planes of symmetry, where the nearest point is not unique or a formula divides by zero.
    for (const glm::dvec3& special :
         {glm::dvec3(0, 0, 0), glm::dvec3(0, 0.5, 0), glm::dvec3(0, 0, 0.3), glm::dvec3(0.1, 0, 0),
          glm::dvec3(0, 1.9, 0.1), glm::dvec3(0, 3, 0), glm::dvec3(1e-12, 0.4, 0.2), glm::dvec3(0, 1.99, 0)}) {
        points.push_back(special);
    }
    for (const glm::dvec3& point : points) {
        INFO(point.x << " " << point.y << " " << point.z);
        CHECK(std::abs(ellipsoid->distance(point)) == Approx(brute_force_distance(point, radii)).margin(1e-7));
    }
}

TEST_CASE("near-flat and needle-like ellipsoids are exact on their axes", "[shape]") {
    const auto flat = shape_of("shape = 'ellipsoid'\ncenter = [0, 0, 0]\nradii = [1, 1e-6, 1]");
    CHECK(flat->distance({0, 5, 0}) == Approx(5 - 1e-6).epsilon(1e-12));
    CHECK(flat->distance({3, 0, 0}) == Approx(2).epsilon(1e-12));
    CHECK(flat->distance({3, 1e-9, 4}) == Approx(4).epsilon(1e-9));
    CHECK(flat->distance({0, 0, 0}) == Approx(-1e-6).epsilon(1e-9));
}

TEST_CASE("normals have unit length and are the slope of the distance", "[shape]") {
    constexpr double h = 1e-6;
    for_each_solid([&](const Shape& shape) {
        int smooth = 0;
        for (const glm::dvec3& point : random_points(200, 3)) {
            const Shape::Sample sample = shape.sample(point);
            REQUIRE(glm::length(sample.normal) == Approx(1).epsilon(1e-9));
            glm::dvec3 slope;
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 step(0);
                step[i] = h;
                slope[i] = (shape.distance(point + step) - shape.distance(point - step)) / (2 * h);
            }
            // On the ridges where two parts of the surface are equally near there is no slope.
            if (glm::length(slope) > 1e-3 && glm::dot(glm::normalize(slope), sample.normal) > 1 - 1e-4) ++smooth;
        }
        CHECK(smooth >= 198);
    });
}

TEST_CASE("sample, distance and inside agree", "[shape]") {
    for_each_solid([](const Shape& shape) {
        for (const glm::dvec3& point : random_points(1000, 3)) {
            const double distance = shape.distance(point);
            REQUIRE(shape.sample(point).distance == Approx(distance).margin(1e-12));
            REQUIRE(shape.inside(point) == (distance <= 0));
        }
    });
}

TEST_CASE("nearest points lie on the surface, and of simple solids at the distance", "[shape]") {
    const auto check = [](const char* toml, bool exact) {
        INFO(toml);
        const auto shape = shape_of(toml);
        for (const glm::dvec3& point : random_points(500, 3)) {
            const Shape::Sample sample = shape->sample(point);
            REQUIRE(std::abs(shape->distance(sample.nearest)) < 1e-9);
            const double away = glm::length(point - sample.nearest);
            if (exact) REQUIRE(away == Approx(std::abs(sample.distance)).margin(1e-9));
            REQUIRE(away >= std::abs(sample.distance) - 1e-9);
        }
    };
    for (const char* toml : simple_solids) check(toml, true);
    for (const char* toml : compounds) check(toml, false);
}

TEST_CASE("moving away along the normal never meets the surface sooner than the distance says", "[shape]") {
    for_each_solid([](const Shape& shape) {
        for (const glm::dvec3& point : random_points(300, 3)) {
            const glm::dvec3 other = point + 0.1 * glm::normalize(point + glm::dvec3(0.1, 0.2, 0.3));
            REQUIRE(std::abs(shape.distance(other) - shape.distance(point)) <= 0.1 + 1e-12);
        }
    });
}

TEST_CASE("bounds hold everything that is inside", "[shape]") {
    for_each_solid([](const Shape& shape) {
        const std::optional<Box> bounds = shape.bounds();
        if (!bounds) return;
        for (const glm::dvec3& point : random_points(3000, 3)) {
            if (!shape.inside(point)) continue;
            for (int i = 0; i < 3; ++i) {
                REQUIRE(point[i] >= bounds->lower[i]);
                REQUIRE(point[i] <= bounds->upper[i]);
            }
        }
    });
}

TEST_CASE("set operations obey the algebra of sets", "[shape]") {
    const std::string a = "{ shape = 'sphere', center = [0, 0, 0], radius = 1 }";
    const std::string b = "{ shape = 'box', lower = [0, -0.5, -2], upper = [2, 1, 2] }";
    const auto combination = [](const char* kind, const std::string& parts) {
        return shape_of("shape = '" + std::string(kind) + "'\nof = [" + parts + "]");
    };
    const auto first = combination("union", a), second = combination("union", b);
    const auto both = combination("union", a + "," + b), common = combination("intersection", b + "," + a);
    const auto without = combination("difference", a + "," + b), nothing = combination("difference", a + "," + a);
    for (const glm::dvec3& point : random_points(10000, 2.5)) {
        const bool in_a = first->inside(point), in_b = second->inside(point);
        REQUIRE(both->inside(point) == (in_a || in_b));
        REQUIRE(common->inside(point) == (in_a && in_b));
        REQUIRE(without->inside(point) == (in_a && !in_b));
        REQUIRE_FALSE(nothing->distance(point) < 0);
        REQUIRE(both->distance(point) == std::min(first->distance(point), second->distance(point)));
        REQUIRE(common->distance(point) == std::max(first->distance(point), second->distance(point)));
    }
}

TEST_CASE("blending swells a union only near the seam", "[shape]") {
    const std::string parts =
        "of = [{ shape = 'sphere', center = [-1, 0, 0], radius = 1.2 },"
        " { shape = 'sphere', center = [1, 0, 0], radius = 1.2 }]";
    const auto sharp = shape_of("shape = 'union'\n" + parts), soft = shape_of("shape = 'union'\nblend = 0.4\n" + parts);
    // Where both distances are equal the smooth minimum is lower by a quarter of `blend`.
    CHECK(soft->distance({0, 1, 0}) == Approx(sharp->distance({0, 1, 0}) - 0.1).epsilon(1e-12));
    CHECK(soft->distance({-2, 1, 0}) == sharp->distance({-2, 1, 0}));
}

TEST_CASE("a transformed solid is the solid at the transformed place", "[shape]") {
    const auto plain = shape_of("shape = 'ellipsoid'\ncenter = [0.3, 0, 0]\nradii = [1, 0.5, 0.7]");
    const auto moved = shape_of(
        "shape = 'ellipsoid'\ncenter = [0.3, 0, 0]\nradii = [1, 0.5, 0.7]\n"
        "scale = 2\nrotate = { axis = [0, 0, 3], angle = 90 }\ntranslate = [0, 0, 5]");
    for (const glm::dvec3& point : random_points(1000, 2)) {
        const glm::dvec3 there = 2.0 * glm::dvec3(-point.y, point.x, point.z) + glm::dvec3(0, 0, 5);
        REQUIRE(moved->distance(there) == Approx(2 * plain->distance(point)).margin(1e-12));
    }
}

TEST_CASE("offset grows and shrinks by metres", "[shape]") {
    const auto grown = shape_of("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\noffset = 0.5");
    const auto shrunk = shape_of("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 2\noffset = -0.5");
    for (const glm::dvec3& point : random_points(1000, 3)) {
        REQUIRE(grown->distance(point) == Approx(shrunk->distance(point)).margin(1e-12));
    }
    CHECK(grown->bounds()->upper.y == Approx(1.5));
}

TEST_CASE("a box of two numbers has no end along z", "[shape]") {
    const auto box = shape_of("shape = 'box'\nlower = [-2.6, 0]\nupper = [2.6, 5.2]");
    CHECK(box->distance({0, 1, 1e6}) == Approx(-1).epsilon(1e-12));
    CHECK(box->distance({3.6, 1, -7}) == Approx(1).epsilon(1e-12));
    CHECK(box->sample({0, 6, 3}).nearest == glm::dvec3(0, 5.2, 3));
    CHECK_FALSE(box->bounds());
}

TEST_CASE("a height field is solid below its heights", "[shape]") {
    // A plane rising along x, so that heights between samples are known.
    const auto slope =
        shape_of("shape = 'height-field'\nheights = [0, 1, 2, 0, 1, 2]\ncolumns = 3\nsize = [2, 1]\nfloor = -1");
    for (const glm::dvec3& point : random_points(10000, 3)) {
        const bool within = point.x >= 0 && point.x <= 2 && point.z >= 0 && point.z <= 1;
        REQUIRE(slope->inside(point) == (within && point.y >= -1 && point.y <= point.x));
    }
    CHECK(slope->distance({1, 1.5, 0.5}) == Approx(0.5 * std::sqrt(0.5)).epsilon(1e-12));
    CHECK(slope->sample({1, 1, 0.5}).normal.y == Approx(std::sqrt(0.5)).epsilon(1e-12));
}

TEST_CASE("distances are the same bits with one thread and with many", "[shape]") {
    const auto shape = shape_of(compounds[1]);
    const std::vector<glm::dvec3> points = random_points(20000, 3);
    const auto distances = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<double> result(points.size());
        for_in_parallel(std::size_t{0}, points.size(), [&](std::size_t i) { result[i] = shape->distance(points[i]); });
        return result;
    };
    CHECK(distances(1) == distances(4));
}

TEST_CASE("mistakes in shapes are told with their place", "[shape]") {
    const auto message = [](const std::string& toml) -> std::string {
        try {
            shape_of(toml);
        } catch (const UserError& error) {
            return error.what();
        }
        return "accepted";
    };
    using Catch::Contains;
    CHECK_THAT(message("shape = 'spere'\nradius = 1"), Contains("test.toml:1") && Contains("did you mean 'sphere'"));
    CHECK_THAT(message("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = -1"), Contains("test.toml:3"));
    CHECK_THAT(message("shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nradios = 2"), Contains("radios"));
    CHECK_THAT(message("shape = 'sphere'\ncenter = [0, 0, nan]\nradius = 1"), Contains("finite"));
    CHECK_THAT(message("shape = 'box'\nlower = [0, 0, 0]\nupper = [1, 0, 1]"), Contains("greater"));
    CHECK_THAT(message("shape = 'box'\nlower = [0, 0]\nupper = [1, 1, 1]"), Contains("as many numbers"));
    CHECK_THAT(message("shape = 'box'\ncenter = [0, 0, 0]"), Contains("'size' is missing"));
    CHECK_THAT(message("shape = 'ellipsoid'\ncenter = [0, 0, 0]\nradii = [1, 0, 1]"), Contains("greater than 0"));
    CHECK_THAT(message("shape = 'cylinder'\nbase = [0, 0, 0]\ntip = [0, 0, 0]\nradius = 1"), Contains("differ"));
    CHECK_THAT(message("shape = 'half-space'\nnormal = [0, 0, 0]"), Contains("[0, 0, 0]"));
    CHECK_THAT(message("shape = 'tube'\npoints = [[0, 0, 0]]\nradius = 1"), Contains("two points"));
    CHECK_THAT(message("shape = 'tube'\npoints = [[0, 0, 0], [0, 0, 0]]\nradius = 1"), Contains("the same"));
    CHECK_THAT(message("shape = 'union'\nof = []"), Contains("'of' is missing"));
    CHECK_THAT(message("shape = 'union'\nof = [{ shape = 'sphere', center = [0, 0, 0] }]"),
               Contains("'radius' is missing"));
    CHECK_THAT(message("shape = 'height-field'\nheights = [0, 1, 2]\ncolumns = 2\nsize = [1, 1]"),
               Contains("full rows"));
    CHECK_THAT(message("radius = 1"), Contains("'shape' is missing"));
}
