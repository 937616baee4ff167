#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "environment/light/shade/exposure.h"
#include "environment/light/sun/sun.h"
#include "environment/space/shapes/tables.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// exposure, sun and sky that a query finds which does not want to grow.
glm::dvec3 light_at(const std::string& solid, const glm::dvec3& place, const std::string& lines = "") {
    Environment environment = environment_of(
        "[light]\nprocess = \"greene\"\nvoxel = 0.001\nsky_samples = 8192\nsolid = " + solid + "\n" + lines);
    AskingPlants plants;
    plants.add({{place, {0, 0, 0, 0, 0, 0, 0}}}).exchange(environment);
    const std::vector<double> answered = plants.parameters();
    return {answered[4], answered[5], answered[6]};
}

const char* const far_ball = "{ shape = 'sphere', center = [0, -9, 0], radius = 1 }";
/// 0.2 m thick, along x, so high and long that it hides half of the sky.
const char* const wall = "{ shape = 'box', lower = [-1000, 0, -0.1], upper = [1000, 1000, 0.1] }";

/// A vine of one axis, grown by asking again and again.
struct Vine {
    explicit Vine(const std::string& lines, const glm::dvec3& seed, int steps) {
        EnvironmentContext context;
        context.plants = 1;
        Environment environment = environment_of("[light]\nprocess = \"greene\"\n" + lines, context);
        nodes.push_back(seed);
        for (int step = 0; step < steps; ++step) {
            AskingPlants plants;
            plants.add({{nodes.back(), {0.1, 0, 0, 0}}}).exchange(environment, step);
            const std::vector<double> answered = plants.parameters();
            for (const Quantity& quantity : environment.statistics(0)) {
                if (quantity.name == "light.chosen" && answered[0] > 0) chosen.push_back(quantity.value);
                if (quantity.name == "light.rejected" && answered[0] > 0) rejected.push_back(quantity.value);
            }
            if (answered[0] > 0)
                nodes.push_back(nodes.back() + 0.1 * glm::dvec3(answered[1], answered[2], answered[3]));
        }
    }
    std::vector<glm::dvec3> nodes;
    std::vector<double> chosen, rejected;
};

}  // namespace

TEST_CASE("in the open the whole sky is seen, and the sun all day", "[greene]") {
    CHECK(light_at(far_ball, {0, 1, 0}) == glm::dvec3(1, 1, 1));
}

TEST_CASE("under a wide slab there is hardly any light", "[greene]") {
    const glm::dvec3 light = light_at("{ shape = 'box', lower = [-20, 1, -20], upper = [20, 1.1, 20] }", {0, 0.5, 0});
    CHECK(light.x < 0.1);
    CHECK(light.x >= 0);
}

TEST_CASE("at the foot of a long wall half of the sky is seen", "[greene]") {
    CHECK(light_at(wall, {0, 0.001, 0.102}).z == Approx(0.5).margin(0.01));
}

TEST_CASE("at the bottom of a well the sky seen is the solid angle of its mouth", "[greene]") {
    for (const double depth : {0.5, 1.0, 2.0}) {
        const std::string well =
            "{ shape = 'difference', of = [{ shape = 'box', lower = [-50, -9, -50], upper = [50, 0, 50] }, "
            "{ shape = 'cylinder', base = [0.0005, -" +
            std::to_string(depth) + ", 0.0005], tip = [0.0005, 1, 0.0005], radius = 1 }] }";
        const double eye = -depth + 0.0005;
        CAPTURE(depth);
        CHECK(light_at(well, {0.0005, eye, 0.0005}).z == Approx(1 + eye / std::hypot(eye, 1)).epsilon(0.02));
    }
}

TEST_CASE("what hides the eastern half of the sky hides the sun for half of the day", "[greene]") {
    const std::string east = "{ shape = 'half-space', point = [0.01, 0, 0], normal = [-1, 0, 0] }";
    CHECK(light_at(east, {0, 1, 0}, "sun_samples = 100").y == Approx(0.5).margin(0.02));
    CHECK(light_at(east, {0, 1, 0}).z == Approx(0.5).margin(0.02));
}

TEST_CASE("a southern wall has more sun than a northern one; on the southern hemisphere it has less", "[greene]") {
    const glm::dvec3 south(0, 1, 0.15), north(0, 1, -0.15);
    CHECK(light_at(wall, south, "latitude = 50").y > light_at(wall, north, "latitude = 50").y + 0.3);
    CHECK(light_at(wall, south, "latitude = -50").y < light_at(wall, north, "latitude = -50").y - 0.3);
}

TEST_CASE("the sun stands highest at noon, and its days are long in summer", "[greene]") {
    const std::vector<double> solstice{172}, winter{355};
    const auto highest = [](const std::vector<glm::dvec3>& path) {
        double most = 0;
        for (const glm::dvec3& direction : path) {
            CHECK(glm::length(direction) == Approx(1));
            CHECK(direction.y > -1e-9);
            most = std::max(most, direction.y);
        }
        return std::asin(most) * 180 / 3.14159265358979;
    };
    CHECK(highest(sun_path(50, solstice, 1001, {0, 0, -1})) == Approx(90 - 50 + 23.44).margin(0.01));
    CHECK(highest(sun_path(50, winter, 1001, {0, 0, -1})) == Approx(90 - 50 - 23.44).margin(0.05));
    CHECK(sun_path(80, winter, 100, {0, 0, -1}).empty());  // polar night
}

TEST_CASE("with a table of the sky, exposure is the share of its photons that are seen", "[greene]") {
    const std::string sky = "sky = { par = 1000, diffuse = 0.4, sun = [0, 1, 1], radiance = 'uniform', rings = 8 }\n";
    CHECK(light_at(far_ball, {0, 1, 0}, sky).x == Approx(1));
    // From the south of the wall the sun and half of the sky are seen, from the north the other half.
    const double sun = 0.6 / std::sqrt(0.5), whole_sky = 2 * 0.4;  // fluence of the light on level ground
    const glm::dvec3 south = light_at(wall, {0, 0.001, 0.102}, sky), north = light_at(wall, {0, 0.001, -0.102}, sky);
    CHECK(south.x == Approx((sun + whole_sky / 2) / (sun + whole_sky)).margin(0.01));
    CHECK(north.x == Approx(whole_sky / 2 / (sun + whole_sky)).margin(0.01));
    CHECK(north.y == 0);
    CHECK(lacks(message_of([&] { light_at(wall, {0, 1, 1}, "sky = { par = 0 }\n"); }), {"without light"}) == "");
}

TEST_CASE("a vine keeps outside the solid, near its surface and above the ground", "[greene]") {
    const std::string box = "{ shape = 'box', lower = [-0.5, 0, -0.5], upper = [0.5, 1, 0.5] }";
    const auto solid = shape_of("shape = 'box'\nlower = [-0.5, 0, -0.5]\nupper = [0.5, 1, 0.5]");
    const Vine vine("spread = 180\nvoxel = 0.1\nreach = 0.15\nclearance = 0.01\nsolid = " + box, {0, 0.02, 0.55}, 150);
    CHECK(vine.nodes.size() > 100);
    int wrong = 0;
    for (std::size_t i = 1; i < vine.nodes.size(); ++i) {
        const glm::dvec3 node = vine.nodes[i], voxel = (glm::floor(node / 0.1) + 0.5) * 0.1;
        const double distance = solid->distance(node);
        wrong += distance < 0.01 || distance > 0.15 || node.y < 0 || solid->inside(voxel);
        for (int k = 1; k < 10; ++k) wrong += solid->inside(glm::mix(vine.nodes[i - 1], node, k / 10.0));
    }
    CHECK(wrong == 0);
}

TEST_CASE("the trials chosen for their light have more of it than those rejected", "[greene]") {
    const Vine vine(std::string("weights = { near = 0, straight = 0, up = 0, crowd = 0 }\nsolid = ") + wall,
                    {0, 0.02, 0.15}, 40);
    REQUIRE(vine.chosen.size() > 20);
    for (std::size_t i = 0; i < vine.chosen.size(); ++i) CHECK(vine.chosen[i] >= vine.rejected[i] - 1e-12);
}

TEST_CASE("a tip is refused that is far from the surface, or among as many nodes as a voxel holds", "[greene]") {
    const auto granted = [](const glm::dvec3& place, int neighbours) {
        EnvironmentContext context;
        context.plants = 1;
        Environment environment =
            environment_of(std::string("[light]\nprocess = \"greene\"\nmost_nodes = 3\nsolid = ") + wall, context);
        std::vector<Asked> questions{{place, {0.01, 0, 0, 0}}};
        for (int i = 0; i < neighbours; ++i) questions.push_back({place, {0}});
        AskingPlants plants;
        plants.add(questions).exchange(environment);
        return plants.parameters()[0];
    };
    CHECK(granted({0.05, 1.05, 0.15}, 1) == 0.01);
    CHECK(granted({0.05, 1.05, 0.15}, 2) == 0);
    CHECK(granted({0.05, 1.05, 0.5}, 0) == 0);
}

namespace {

/// Exposure at the origin of a voxel of 1 m, below square leaves that lie flat at these heights.
double light_below(const std::vector<double>& heights, double half, const std::string& lines) {
    Environment environment = environment_of(std::string("[light]\nprocess = \"greene\"\nvoxel = 1\nsolid = ") +
                                             far_ball + "\nsky_samples = 8192\nsun_share = 0\n" + lines);
    AskingPlants plants;
    plants.add({{{0.5, 0.5, 0.5}, {0, 0, 0, 0, 0}}});
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    for (const double y : heights) {
        for (double x = -half; x < half; ++x) {
            for (double z = -half; z < half; ++z) {
                geometry.polygons.push_back({0, std::uint32_t(geometry.vertices.size()), 4, 0, 0});
                for (const glm::dvec3& corner : {glm::dvec3(x, y, z), glm::dvec3(x + 1, y, z),
                                                 glm::dvec3(x + 1, y, z + 1), glm::dvec3(x, y, z + 1)})
                    geometry.vertices.push_back(corner);
            }
        }
    }
    plants.exchange(environment);
    return plants.parameters()[4];
}

}  // namespace

TEST_CASE("leaves hide the sky as the mean of exp(-k LAI / sin(height)) over it", "[greene]") {
    // A canopy almost without end, of one layer of leaves in a layer of voxels: light from the height with the sine s
    // crosses the leaf area 1 / s. The mean over the sky is the exponential integral of the second order, E2(k).
    const double e2_of_half = 0.3266439;
    CHECK(light_below({2.5}, 200, "extinction = 0.5") == Approx(e2_of_half).margin(0.01));
    const double e2_of_one = 0.1484955;
    CHECK(light_below({2.5, 3.5}, 200, "extinction = 0.5") == Approx(e2_of_one).margin(0.01));
    CHECK(light_below({2.5}, 4, "") == 1);
    CHECK(light_below({}, 60, "extinction = 0.5") == 1);
    CHECK(light_below({-2.5}, 60, "extinction = 0.5") == 1);
}

TEST_CASE("leaves may cover a part of the sky", "[greene]") {
    const double small = light_below({2.5}, 1, "extinction = 0.5"), large = light_below({2.5}, 4, "extinction = 0.5");
    CHECK(small < 1);
    CHECK(large < small);
    CHECK(light_below({2.5}, 4, "extinction = 2") < large);
}

TEST_CASE("faults of greene's settings are told by name", "[greene]") {
    const auto fault = [](const std::string& lines) {
        return message_of(
            [&] { environment_of("[light]\nprocess = \"greene\"\nsolid = " + std::string(far_ball) + "\n" + lines); });
    };
    CHECK(lacks(fault("north = [0, 1, 0]"), {"'north'", "horizontal"}) == "");
    CHECK(lacks(fault("trials = 0"), {"'trials'", "1"}) == "");
    CHECK(lacks(fault("extinction = -1"), {"'extinction'"}) == "");
    CHECK(lacks(fault("sun_share = 2"), {"'sun_share'"}) == "");
}
