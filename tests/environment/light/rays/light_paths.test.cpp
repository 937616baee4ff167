#include "environment/light/rays/light_paths.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"
#include "environment/light/rays/solid_surface.h"
#include "environment/space/shapes/tables.h"
#include "geometry/rays/ray_scene.h"

#include <glm/geometric.hpp>

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::string all_absorbed = "bands.par = { leaf = [0, 0], stem = 0, soil = 0 }\n";

}  // namespace

TEST_CASE("100,000 black leaves of five distributions let exp(-G LAI / cos zenith) through", "[ray-light]") {
    constexpr double side = 0.008;
    constexpr int count = 100000;
    const double area_index = count * side * side / 4;
    const Optics optics(Settings::parse_toml("bands.par = { leaf = [0, 0], soil = 0 }\n", "scene.toml"));
    std::uint64_t seed = 50;
    double apart = 0;
    for (const char* name : {"spherical", "planophile", "erectophile", "plagiophile", "uniform"}) {
        PlantGeometry geometry;
        draw_at_random(geometry, 0, count, side, ++seed, name);
        LitTriangles triangles;
        triangles.add(geometry, 0, 0, optics);
        LightPaths paths(optics, {}, {0, Box{{0, 0, 0}, {2, 3, 2}}, 0.001});
        for (const double zenith : {0.0, 0.35, 0.7, 1.05, 1.3}) {
            Daylight light;
            light.beams.push_back({{std::sin(zenith), std::cos(zenith), 0}, 1});
            CHECK(paths.set(triangles, 1, light, {}, 0, std::array{1.0}) == (zenith == 0 ? 1 : 0));
            paths.trace(16384, 7);
            const double exact = std::exp(-plain_projection(name, zenith) * area_index / std::cos(zenith));
            CAPTURE(name, zenith);
            // Four times the spread of such a stand's own gaps and of so many paths.
            CHECK(paths.absorbed_by_soil(0) == Approx(exact).margin(0.015));
            apart += (paths.absorbed_by_soil(0) / exact - 1) / 25;
        }
    }
    CHECK(std::abs(apart) < 0.005);
}

TEST_CASE("horizontal leaves divide light as the two-stream equations say", "[ray-light]") {
    for (const auto& [r, t, s] : {std::array{0.08, 0.05, 0.15}, {0.45, 0.42, 0.25}}) {
        Environment light = light_process(
            "ray-light", "periodic = true\npaths = 32768\nresidual = 1e-4\nbands.par = { leaf = [" + std::to_string(r) +
                             ", " + std::to_string(t) + "], soil = " + std::to_string(s) + " }\n" + sun_at(0.5));
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        PlantGeometry& geometry = plants.interpretation(0).geometry;
        RandomSamples samples(RandomKey(9, 0, Stream::process, 1), 5, 0);
        constexpr int leaves = 12000;
        for (int i = 0; i < leaves; ++i) {
            const glm::dvec3 place(2 * samples.uniform(), 0.02 + 2.9 * samples.uniform(), 2 * samples.uniform());
            draw_square(geometry, 1, place, {1, 0, 0}, {0, 0, -1}, 0.03);
        }
        plants.exchange(light, 1);
        const TwoStreams exact(leaves * 0.0009 / 4, r, t, s);
        CHECK(statistic(light, "soil") == Approx((1 - s) * exact.down).margin(0.006));
        CHECK(statistic(light, "escaped") == Approx(exact.up).margin(0.006));
    }
}

TEST_CASE("two facing plates exchange what their view factor says", "[ray-light]") {
    // The lower plate is lit from above through the upper one's absence: both stand upright, and the sun shines from
    // the side onto the one.
    Environment light = light_process("ray-light",
                                      "paths = 600000\nresidual = 1e-5\n"
                                      "bands.par = { leaf = [0.05, 0], soil = 0 }\n"
                                      "sky = { par = 1000, diffuse = 0, sun = [-2, 1, 0] }\n");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    // Light from the side of -x passes above the first plate's top edge and falls on the whole of the second.
    draw_square(geometry, 1, {0, 1, 0.5}, {0, 1, 0}, {0, 0, 1}, 1);
    draw_square(geometry, 3, {2, 1, 0.5}, {0, 1, 0}, {0, 0, 1}, 1);
    plants.exchange(light, 1);
    const double on_second = plants.parameters()[4] / 0.95;
    const double on_first_from_sun = 2 * 86.4;
    const double distance = 2, x = 1 / distance;  // Howell, Siegel & Menguc 2010, C-11: unit squares
    const double factor = 2 / (std::numbers::pi * x * x) *
                          (0.5 * std::log((1 + x * x) * (1 + x * x) / (1 + 2 * x * x)) +
                           2 * x * std::sqrt(1 + x * x) * std::atan(x / std::sqrt(1 + x * x)) - 2 * x * std::atan(x));
    const double on_first = plants.parameters()[1] / 0.95;
    CHECK(on_second == Approx(2 * 86.4).epsilon(0.005));
    CHECK(on_first - on_first_from_sun == Approx(0.05 * factor * on_second).margin(0.25));
}

TEST_CASE("a solid takes the light away from what is behind it, and reflects its own share", "[ray-light]") {
    Environment light = light_process("ray-light",
                                      "paths = 200000\nbands.par = { leaf = [0, 0], soil = 0, solid = 0.3 }\n"
                                      "solids = [{ shape = 'sphere', center = [1, 2, 1], radius = 0.5 }]\n" +
                                          sun_at(0));
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
    draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.3);
    draw_square(plants.interpretation(0).geometry, 3, {2, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.3);
    plants.exchange(light, 1);
    CHECK(plants.parameters()[0] == 0);
    CHECK(plants.parameters()[2] == Approx(1).epsilon(0.03));
    CHECK(std::abs(statistic(light, "closure")) < 1e-6);
    // Of what a Lambertian ball sends back to parallel light from above, a sixth goes down to the black soil.
    CHECK(statistic(light, "escaped") / statistic(light, "solids") == Approx(0.3 * 5 / 6 / 0.7).epsilon(0.02));
}

TEST_CASE("the surface of a ball has its area, and faces outwards", "[rays]") {
    const auto ball = shape_of("shape = 'sphere'\ncenter = [1, 2, 3]\nradius = 0.7");
    const TriangleMesh mesh = surface_of(*ball, 0.03);
    double area = 0, outward = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 normal = 0.5 * glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
        area += glm::length(normal);
        outward += glm::dot(normal, glm::normalize(mesh.points[a] - glm::dvec3(1, 2, 3)));
    }
    CHECK(area == Approx(4 * std::numbers::pi * 0.49).epsilon(0.01));
    CHECK(outward == Approx(area).epsilon(0.02));
}

TEST_CASE("sensors count the light that passes them, and take none of it", "[ray-light]") {
    const std::string lines = "periodic = true\npaths = 50000\n" + all_absorbed + "bands.nir = {}\n" + sun_at(0.5);
    const std::string sensors =
        "sensors = [{ name = 'top', at = [1, 2.99, 1], size = [2, 2] },\n"
        "{ name = 'below', at = [1, 0.5, 1], normal = [0, -1, 0], size = [1, 1] },\n"
        "{ name = 'ground', at = [1, 0.001, 1], size = [2, 2], cells = [4, 4] }]\n";
    Environment counted = light_process("ray-light", lines + sensors), plain = light_process("ray-light", lines);
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
    draw_at_random(plants.interpretation(0).geometry, 1, 3000, 0.05, 4);
    plants.exchange(counted, 1);
    plants.exchange(plain, 1);
    CHECK(statistic(counted, "absorbed") == Approx(statistic(plain, "absorbed")).epsilon(0.002));
    CHECK(statistic(counted, "sensor.top") == Approx(86.4).epsilon(1e-6));
    CHECK(statistic(counted, "sensor.below") == 0);
    // Of all light, the soil has its share as organs find theirs, and the sensor counts paths.
    CHECK(statistic(counted, "sensor.ground") == Approx(86.4 * statistic(counted, "soil")).epsilon(1e-3));
    CHECK(statistic(counted, "sensor.below.nir") > 0);
}

TEST_CASE("a part that has not changed is not built again, and light in it is the same", "[rays]") {
    const std::vector<glm::vec3> one{{0, 1, 0}, {1, 1, 0}, {0, 1, 1}};
    std::vector<glm::vec3> two{{0, 2, 0}, {1, 2, 0}, {0, 2, 1}};
    RayScene scene;
    const auto set = [&] {
        const std::vector<RayScene::Part> parts{{one, {moved_by({0, 0, 0}), moved_by({5, 0, 0})}},
                                                {two, {moved_by({0, 0, 0})}}};
        return scene.set_parts(parts);
    };
    CHECK(set() == 2);
    CHECK(set() == 0);
    two[0].y = 3;
    CHECK(set() == 1);
    const auto shifted = scene.first_hit({5.2f, 0, 0.2f}, {0, 1, 0}, 0, 100);
    REQUIRE(shifted);
    CHECK(shifted->part == 0);
    CHECK(shifted->distance == Approx(1));
    CHECK_FALSE(scene.first_hit({9.2f, 0, 0.2f}, {0, 1, 0}, 0, 100));
    const std::vector<RayScene::Part> first{{one, {moved_by({0, 0, 0})}}};
    CHECK(scene.set_parts(first) == 0);
    CHECK_FALSE(scene.first_hit({5.2f, 0, 0.2f}, {0, 1, 0}, 0, 100));
}

TEST_CASE("plants that stand within each other are one part of the scene, and get the light of separate ones",
          "[rays]") {
    const Optics optics(Settings::parse_toml("bands.par = { leaf = [0.3, 0.2], soil = 0.1 }\n", "scene.toml"));
    const Box period{{0, 0, 0}, {2, 3, 2}};
    constexpr std::uint32_t plants = 8, leaves = 40;
    const auto draw = [&](PlantGeometry& geometry, std::uint32_t plant) {
        const std::size_t first = geometry.polygons.size();
        draw_at_random(geometry, 0, leaves, 0.1, plant + 1);
        for (std::size_t i = first; i < geometry.polygons.size(); ++i) geometry.polygons[i].module = std::uint32_t(i);
    };
    PlantGeometry all;
    LitTriangles mixed, one;
    for (std::uint32_t plant = 0; plant < plants; ++plant) {
        PlantGeometry geometry;
        draw(geometry, plant);
        mixed.add(geometry, plant * leaves, plant, optics);
        draw(all, plant);
    }
    one.add(all, 0, 0, optics);
    CHECK(mixed.parts(period).size() == 1);
    Daylight light;
    light.beams.push_back({glm::normalize(glm::dvec3(0.3, 1, 0.1)), 1});
    LightPaths in_mixed(optics, {}, {.period = period}), in_one(optics, {}, {.period = period});
    for (const auto& [paths, triangles] : {std::pair{&in_mixed, &mixed}, {&in_one, &one}}) {
        paths->set(*triangles, plants * leaves, light, {}, 0, std::array{1.0});
        paths->trace(20000, 3);
    }
    for (std::uint32_t slot = 0; slot < plants * leaves; ++slot) {
        REQUIRE(in_mixed.absorbed(slot, 0) == in_one.absorbed(slot, 0));
    }
}

TEST_CASE("plants that stand apart are parts of their own", "[rays]") {
    const Optics optics(Settings::parse_toml("bands.par = { leaf = [0, 0], soil = 0 }\n", "scene.toml"));
    LitTriangles triangles;
    for (std::uint32_t plant = 0; plant < 4; ++plant) {
        PlantGeometry geometry;
        draw_square(geometry, 0, {3.0 * plant, 1, 0}, {1, 0, 0}, {0, 0.6, 0.8}, 1);
        triangles.add(geometry, plant, plant, optics);
    }
    CHECK(triangles.parts(std::nullopt).size() == 4);
}

TEST_CASE("triangles without area take no light and do no harm", "[ray-light]") {
    Environment light = light_process("ray-light", "paths = 1024\n" + sun_at(0));
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    for (int i = 0; i < 200000; ++i) draw_square(geometry, 1, {1, 1, 1}, {1, 0, 0}, {1, 0, 0}, 0);
    plants.exchange(light, 1);
    CHECK(statistic(light, "absorbed") == 0);
    CHECK(statistic(light, "leaf_area") == 0);
}

TEST_CASE("organs know the light of either side, their sunlit share and where it is brightest",
          "[ray-light][canopy-light]") {
    for (const char* process : {"ray-light", "canopy-light"}) {
        Environment light = light_process(process,
                                          "voxel = 0.5\npaths = 400000\nbands.par = { leaf = [0.2, 0.1], soil = 0 }\n"
                                          "sky = { par = 1000, diffuse = 0.2, sun = [1, 1, 0] }\n");
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        PlantGeometry& geometry = plants.interpretation(0).geometry;
        draw_square(geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, -1}, 0.04);
        plants.exchange(light, 1);
        const auto values = [&](const char* name) { return *light.organ_values(std::string("light.") + name, 0); };
        CAPTURE(process);
        CHECK(values("front")[1] == Approx(0.0016 * 86.4).epsilon(0.05));
        CHECK(values("back")[1] < 0.01 * values("front")[1]);
        const double fallen = values("front")[1] + values("back")[1];
        CHECK(values("absorbed")[1] == Approx(0.7 * fallen).epsilon(1e-5));
        CHECK(values("reflected")[1] == Approx(0.3 * fallen).epsilon(1e-5));
        CHECK(values("flux")[1] == Approx(0.7 * 1000).epsilon(0.05));
        CHECK(values("sunlit")[1] == Approx(1).epsilon(0.06));
        CHECK(std::isnan(values("flux")[0]));
        CHECK(values("brightest")[3] > 0.5f);
        CHECK(values("brightest")[4] > 0.6f);
    }
}

TEST_CASE("errors of even paths fall at least as Monte Carlo's, and are less from the beginning", "[ray-light]") {
    const Optics optics(Settings::parse_toml("bands.par = { leaf = [0, 0], soil = 0 }\n", "scene.toml"));
    PlantGeometry geometry;
    draw_at_random(geometry, 0, 2000, 0.04, 3);
    LitTriangles triangles;
    triangles.add(geometry, 0, 0, optics);
    Daylight light;
    light.beams.push_back({glm::normalize(glm::dvec3(0.3, 1, 0.1)), 1});
    const auto spread = [&](bool evenly, std::uint32_t paths) {
        LightPaths traced(optics, {}, {.ground = 0, .period = Box{{0, 0, 0}, {2, 3, 2}}, .evenly = evenly});
        traced.set(triangles, 1, light, {}, 0, std::array{1.0});
        double sum = 0, squares = 0;
        constexpr int trials = 16;
        for (std::uint32_t seed = 0; seed < trials; ++seed) {
            traced.trace(paths, 1000 + seed);
            sum += traced.absorbed(0, 0);
            squares += traced.absorbed(0, 0) * traced.absorbed(0, 0);
        }
        return std::sqrt((squares - sum * sum / trials) / (trials - 1));
    };
    const double few = spread(true, 1 << 9), many = spread(true, 1 << 15), random = spread(false, 1 << 15);
    CHECK(many < few / 8);
    CHECK(many < random / 1.5);  // at 2^18 paths 3 to 5 times less
}
