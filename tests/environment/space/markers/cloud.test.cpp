// Clouds of attraction points: their number, their form, what is refused.
#include "environment/space/markers/cloud.h"

#include "catch.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

using namespace espalier;
using namespace espalier::environment;
using Catch::Contains;

namespace {

std::vector<glm::dvec3> points_of(const std::string& text, std::uint64_t seed = 1, std::size_t most = 10000000) {
    EnvironmentContext context;
    context.seed = seed;
    return read_clouds(Settings::parse_toml(text, "scene.toml"), context, most);
}

/// Returns chi square for `counts` expected to be equal.
double chi_square(const std::array<int, 8>& counts) {
    double total = 0, sum = 0;
    for (const int count : counts) total += count;
    for (const int count : counts) sum += (count - total / 8) * (count - total / 8) / (total / 8);
    return sum;
}

}  // namespace

TEST_CASE("a layer of the unit ball has the volume pi (z - z^3 / 3) between its cuts", "[markers]") {
    CHECK(ball_layer_volume(-1, 1) == Approx(4 * std::numbers::pi / 3));
    CHECK(ball_layer_volume(0, 1) == Approx(2.0944).epsilon(1e-5));
    CHECK(ball_layer_volume(-0.5, 0.5) == Approx(2 * std::numbers::pi * (0.5 - 0.125 / 3)));
}

TEST_CASE("an ellipsoid has density times volume points, all inside, above its base", "[markers]") {
    const auto points =
        points_of("cloud = { radii = [2, 3, 1], below = 0.25, above = 0.1, base = [1, 2, 3], density = 100 }");
    const double volume = 6 * ball_layer_volume(-0.5, 0.8);
    CHECK(points.size() == static_cast<std::size_t>(std::round(100 * volume)));
    for (const glm::dvec3& point : points) {
        const glm::dvec3 unit = (point - glm::dvec3(1, 2, 3)) / glm::dvec3(2, 3, 1) + glm::dvec3(0, -0.5, 0);
        REQUIRE(glm::length(unit) <= 1 + 1e-12);
        REQUIRE(point.y >= 2);
        REQUIRE(unit.y <= 0.8 + 1e-12);
    }
}

TEST_CASE("a rough cloud is the smooth one without parts of its rim", "[markers]") {
    const auto cloud = [](double rough) {
        return points_of(
            "cloud = { radii = [1, 1, 1], base = [0, -1, 0], number = 40000, rough = " + std::to_string(rough) + " }");
    };
    const auto smooth = cloud(0);
    CHECK(smooth.size() == 40000);
    std::size_t before = smooth.size();
    for (const double rough : {0.1, 0.3, 0.6}) {
        const auto points = cloud(rough);
        CHECK(points.size() < before);
        before = points.size();
        const auto inner = [&](const std::vector<glm::dvec3>& all) {
            return std::count_if(all.begin(), all.end(), [&](auto& p) { return glm::length(p) < 1 - rough; });
        };
        CHECK(inner(points) == inner(smooth));
        CHECK(std::count_if(points.begin(), points.end(), [&](auto& p) { return glm::length(p) > 1 - 0.4 * rough; }) >
              0);
    }
}

TEST_CASE("however rough its rim, a cloud is as wide, high and deep as it should be", "[markers]") {
    for (const double rough : {0.2, 0.35, 0.7}) {
        const double near = rough < 0.5 ? 0.07 : 0.14;  // a spike that is left is thin: few points lie at its end
        for (const auto& [below, above] : {std::pair(0.0, 0.0), {0.1, 0.0}, {0.5, 0.2}, {0.7, 0.0}}) {
            const double lower = -1 + 2 * below, upper = 1 - 2 * above, middle = std::clamp(0.0, lower, upper);
            const double widest = std::sqrt(1 - middle * middle);
            for (int seed = 1; seed <= 8; ++seed) {
                INFO(rough << ", cut " << below << " below and " << above << " above, seed " << seed);
                Box box;
                for (const glm::dvec3& point : points_of(fmt::format(
                         "cloud = {{ radii = [1, 1, 1], base = [0, {}, 0], number = 40000, rough = {}, below = {}, "
                         "above = {}, seed = {} }}",
                         lower, rough, below, above, seed))) {
                    box.add(point);
                }
                for (const int axis : {0, 2}) {
                    CHECK(box.lower[axis] == Approx(-widest).margin(near));
                    CHECK(box.upper[axis] == Approx(widest).margin(near));
                }
                CHECK(box.lower.y == Approx(lower).margin(near));
                CHECK(box.upper.y == Approx(upper).margin(near));
            }
        }
    }
}

TEST_CASE("points are uniform: the octants of a ball hold as many each", "[markers]") {
    std::array<int, 8> octants{};
    for (const glm::dvec3& point : points_of("cloud = { radii = [1, 1, 1], base = [0, -1, 0], number = 80000 }")) {
        ++octants[static_cast<std::size_t>((point.x > 0) + 2 * (point.y > 0) + 4 * (point.z > 0))];
    }
    CHECK(chi_square(octants) < 24.3);  // 7 degrees of freedom, p = 0.001
}

TEST_CASE("a shape is filled with density times its volume", "[markers]") {
    const auto points = points_of(
        "cloud = { shape = { shape = 'cylinder', base = [0, 0, 0], tip = [0, 2, 0], radius = 0.5 }, "
        "density = 1000 }");
    CHECK(static_cast<double>(points.size()) == Approx(1000 * std::numbers::pi * 0.25 * 2).epsilon(0.005));
    for (const glm::dvec3& point : points) REQUIRE(std::hypot(point.x, point.z) <= 0.5 + 1e-12);
}

TEST_CASE("the seeds of scene and cloud give other points of the same cloud", "[markers]") {
    const std::string cloud = "cloud = { radii = [1, 1, 1], number = 100, seed = 4 }";
    CHECK(points_of(cloud, 1) == points_of(cloud, 1));
    CHECK(points_of(cloud, 1) != points_of(cloud, 2));
    CHECK(points_of(cloud, 1) != points_of("cloud = { radii = [1, 1, 1], number = 100, seed = 5 }", 1));
}

TEST_CASE("several clouds are one after the other", "[markers]") {
    const auto points =
        points_of("[[cloud]]\npoints = [[1, 2, 3], [4, 5, 6]]\n[[cloud]]\nradii = [1, 1, 1]\nnumber = 10\n");
    REQUIRE(points.size() == 12);
    CHECK(points[1] == glm::dvec3(4, 5, 6));
}

TEST_CASE("a cloud that cannot be is refused with the key and what to do", "[markers]") {
    const auto refuses = [](const std::string& text, const std::string& message) {
        INFO(text);
        CHECK_THROWS_WITH(points_of(text, 1, 1000), Contains(message));
    };
    refuses("", "there is no cloud");
    refuses("cloud = { density = 3 }", "one of 'radii'");
    refuses("cloud = { radii = [1, 1, 1], density = 0.01 }", "no points: raise 'density'");
    refuses("cloud = { radii = [1, 1, 1], density = 1e9 }", "more than the memory of the process holds (1000)");
    refuses("cloud = { radii = [1, 1, 1], number = 100000000 }", "lower 'number'");
    refuses("cloud = { radii = [1, 1, 1], number = 5, density = 5 }", "either 'number' or 'density'");
    refuses("cloud = { radii = [1, 0, 1] }", "'radii' must be three lengths above 0");
    refuses("cloud = { radii = [1, nan, 1] }", "radii");
    refuses("cloud = { radii = [1, 1, 1], below = 0.6, above = 0.5 }", "cut off the whole cloud");
    refuses("cloud = { points = [] }", "'points' is empty");
    refuses("cloud = { points = [[0, inf, 0]] }", "finite number");
    refuses("cloud = { shape = { shape = 'half-space', point = [0, 0, 0], normal = [0, 1, 0] }, number = 5 }",
            "give the scene a domain");
    refuses("cloud = { radii = [1, 1, 1], densty = 5 }", "densty");
    refuses(
        "cloud = { shape = { shape = 'intersection', of = [{ shape = 'sphere', radius = 1, center = [0, 0, 0] }, { "
        "shape = 'sphere', "
        "radius = 1, center = [5, 0, 0] }] } }",
        "enclose");
}
