#include "espalier/base/error.h"

#include "archive/landscape/cover.h"
#include "archive/landscape/planted.h"
#include "catch.h"

#include <glm/geometric.hpp>

#include <numbers>

using namespace espalier;
using Catch::Contains;

TEST_CASE("a card has two triangles and faces the eye from 100 angles", "[landscape]") {
    const FrameMesh mesh = card_mesh({{0, 1, 0}, {-1, -1}, {1, 1}}, "tree");
    CHECK(mesh.triangles.size() == 2);
    const glm::dvec3 place(3, 1, -2);
    for (int i = 0; i < 100; ++i) {
        const double azimuth = 2.399963 * i, elevation = std::asin(0.99 * (2 * (i + 0.5) / 100 - 1));
        const glm::dvec3 line(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                              std::cos(elevation) * std::cos(azimuth));
        const glm::dquat turn = towards_eye(place, place + 37.0 * line);
        const auto [a, b, c] = mesh.triangles[0];
        const glm::dvec3 normal = turn * glm::normalize(glm::cross(glm::dvec3(mesh.points[b] - mesh.points[a]),
                                                                   glm::dvec3(mesh.points[c] - mesh.points[a])));
        CHECK(glm::dot(normal, line) > 0.999);
        CHECK((turn * glm::dvec3(0, 1, 0)).y >= 0);
        CHECK(std::abs((turn * glm::dvec3(1, 0, 0)).y) < 1e-9);  // the plant stands upright in the picture
    }
}

TEST_CASE("a card right beneath the eye, or at it, still has a direction", "[landscape]") {
    CHECK(glm::length(towards_eye({0, 0, 0}, {0, 5, 0}) * glm::dvec3(0, 0, 1) - glm::dvec3(0, 1, 0)) < 1e-9);
    CHECK(glm::length(towards_eye({1, 2, 3}, {1, 2, 3})) == Approx(1));
}

TEST_CASE("a terrain goes straight from place to place, and its mesh lies on it", "[landscape]") {
    const auto plane = [](double x, double z) { return 3 + 0.5 * x - 0.25 * z; };
    const Terrain terrain({-10, -20}, {30, 20}, {5, 9}, plane);
    for (const double x : {-10.0, -3.0, 12.5, 30.0}) {
        for (const double z : {-20.0, 0.3, 19.0}) CHECK(terrain.height(x, z) == Approx(plane(x, z)));
    }
    CHECK(terrain.height(100, 0) == Approx(plane(30, 0)));
    CHECK(terrain.holds(30, 20));
    CHECK_FALSE(terrain.holds(30.1, 0));
    const FrameMesh mesh = terrain.mesh({{1, 2, 3}});
    CHECK(mesh.triangles.size() == 2 * 4 * 8);
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 across = glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
        CHECK(across.y > 0);
        area += across.y / 2;
    }
    CHECK(area == Approx(40 * 40));
    for (const glm::vec3& point : mesh.points) CHECK(point.y == Approx(plane(point.x, point.z)));
}

TEST_CASE("a ground of two colours has shades between them, as its share says", "[landscape]") {
    const Terrain terrain({-10, -10}, {10, 10}, {41, 3}, [](double, double) { return 0; });
    CHECK(terrain.mesh({{1, 2, 3}}).materials.size() == 1);
    const auto share = [](double x, double) { return x < -5 ? -3 : x > 5 ? 3 : (x + 5) / 10; };
    const FrameMesh mesh = terrain.mesh({{0, 100, 40}, {200, 0, 40}, share});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const double x = (mesh.points[a].x + mesh.points[b].x + mesh.points[c].x) / 3;
        const double second = std::clamp((x + 5) / 10, 0.0, 1.0);
        const Rgb& rgb = mesh.materials[mesh.material_of[i]].rgb;
        CHECK(rgb[0] == Approx(200 * second).margin(5));
        CHECK(rgb[1] == Approx(100 - 100 * second).margin(3));
        CHECK(rgb[2] == 40);
    }
    const auto root = [](double x, double) { return std::sqrt(x); };
    CHECK_THROWS_WITH(terrain.mesh({{0, 0, 0}, {9, 9, 9}, root}), Contains("no colour at x = -10"));
}

TEST_CASE("species of one colour are individuals, each as likely as the others", "[landscape]") {
    std::vector<StandPlant> stand;
    for (int i = 0; i < 3000; ++i) stand.push_back({{i % 60 - 30.0, i / 60 - 25.0}, 1, i % 2 ? 1 : 5});
    const std::vector<LandscapeSpecies> species{small_species(1), small_species(5), small_species(1), small_species(1)};
    const PlantedLandscape landscape = planted(flat_terrain(), species, stand, {0, 2, 400}, few_levels, 3);
    std::vector<int> count(4);
    for (std::size_t i = 0; i < stand.size(); ++i) {
        const std::uint16_t one = landscape.plants[i].species;
        CHECK(species[one].number == stand[i].species);
        ++count[one];
    }
    for (const int one : {0, 2, 3}) CHECK(count[std::size_t(one)] == Approx(500).margin(4 * std::sqrt(333)));
    CHECK(count[1] == 1500);
}

TEST_CASE("a cover has its density near the eye, less beyond half of its distance, and stays where it is",
          "[landscape]") {
    for (const std::uint64_t seed : {1u, 17u, 23456u}) {
        const Cover cover{-1, 4, 40, 0.5};
        const glm::dvec3 eye(100.3, 7, -60.7);
        std::vector<int> in_ring(4);
        double radii = 0;
        const auto plants = plants_of(cover, eye, seed);
        for (const StandPlant& plant : plants) {
            const double away = glm::distance(plant.place, glm::dvec2(eye.x, eye.z));
            REQUIRE(away < 40);
            ++in_ring[static_cast<std::size_t>(away / 10)];
            radii += plant.radius;
            CHECK(plant.radius >= 0.3);
            CHECK(plant.radius <= 0.7);
            CHECK(plant.species == -1);
        }
        CHECK(radii / double(plants.size()) == Approx(0.5).epsilon(0.02));
        const double area = std::numbers::pi * 100;
        CHECK(in_ring[0] == Approx(4 * area).epsilon(0.06));
        CHECK(in_ring[1] == Approx(4 * 3 * area).epsilon(0.04));
        CHECK(in_ring[2] < 0.85 * 4 * 5 * area);
        CHECK(in_ring[3] < 0.35 * 4 * 7 * area);
        // a step aside, the plants near both eyes are the same
        std::size_t same = 0, near = 0;
        const auto moved = plants_of(cover, eye + glm::dvec3(5, 0, 0), seed);
        for (const StandPlant& plant : plants) {
            if (glm::distance(plant.place, glm::dvec2(eye.x, eye.z)) > 14) continue;
            ++near;
            same += std::any_of(moved.begin(), moved.end(),
                                [&](const StandPlant& other) { return other.place == plant.place; });
        }
        CHECK(same == near);
    }
    CHECK_THROWS_WITH(plants_of({-1, 100, 1000, 1}, {0, 0, 0}, 0), Contains("a cover of 3.14e+08 plants"));
}

TEST_CASE("a terrain without a height somewhere, or too large, is refused", "[landscape]") {
    const auto root = [](double x, double) { return std::sqrt(x); };
    CHECK_THROWS_WITH(Terrain({-1, 0}, {1, 1}, {3, 3}, root), Contains("no height at x = -1"));
    CHECK_THROWS_AS(Terrain({0, 0}, {1, 1}, {1, 3}, root), UserError);
    CHECK_THROWS_AS(Terrain({0, 0}, {1, 1}, {100000, 100000}, root), UserError);
}

TEST_CASE("plants of a stand stand on the terrain, as large as their crowns", "[landscape]") {
    const LandscapeSpecies species = small_species();
    const Terrain hill({-50, -50}, {50, 50}, {11, 11}, [](double x, double) { return 0.1 * x; });
    const std::vector<StandPlant> stand{
        {{10, 5}, 2 * species.radius, 1}, {{-30, 5}, species.radius, 1}, {{70, 0}, 1, 1}};
    const PlantedLandscape landscape = planted(hill, {species}, stand, {0, 2, 40}, few_levels, 7);
    REQUIRE(landscape.plants.size() == 2);
    CHECK(landscape.outside == 1);
    CHECK(landscape.plants[0].position.y == Approx(1));
    CHECK(landscape.plants[0].scale == Approx(2));
    CHECK(landscape.plants[1].position.y == Approx(-3));
    CHECK(landscape.plants[1].scale == Approx(1));
    CHECK_THROWS_WITH(planted(hill, {small_species(2)}, stand, {0, 2, 40}, few_levels, 7),
                      Contains("colour 1") && Contains("there are 2"));
}

TEST_CASE("the farther a plant of its size, the fewer its triangles; from the last distance on it is a card",
          "[landscape]") {
    const LandscapeSpecies species = small_species();
    std::size_t before = species.triangles;
    for (const FrameMesh& level : species.levels) {
        CHECK(level.triangles.size() <= before);
        before = level.triangles.size();
    }
    CHECK(species.levels.front().triangles.size() == species.triangles);
    CHECK(before < species.triangles / 2);
    CHECK(few_levels.level(0) == 0);
    CHECK(few_levels.level(19.9) == 0);
    CHECK(few_levels.level(20) == 1);
    CHECK(few_levels.level(199) == 2);
    CHECK(few_levels.level(200) == few_levels.levels.size());
    std::vector<StandPlant> stand;
    for (int i = 1; i <= 40; ++i) stand.push_back({{0, -10.0 * i}, species.radius, 1});
    const PlantedLandscape landscape = planted(flat_terrain(), {species}, stand, {0, 0, 0}, few_levels, 0);
    std::uint16_t level = 0;
    for (const PlantedPlant& plant : landscape.plants) {
        CHECK(plant.level >= level);
        level = plant.level;
    }
    CHECK(level == PlantedPlant::card_level);
}

TEST_CASE("the triangles of a landscape are the sum over species and levels of plants times triangles", "[landscape]") {
    const std::vector<LandscapeSpecies> species{small_species(1), small_species(2)};
    std::vector<StandPlant> stand;
    for (int i = 0; i < 1000; ++i) {
        stand.push_back({{(i % 32 - 16) * 20.0, (i / 32 - 16) * 20.0}, 0.5 + 0.001 * i, 1 + i % 2});
    }
    const PlantedLandscape landscape = planted(flat_terrain(), species, stand, {0, 5, 0}, few_levels, 1);
    REQUIRE(landscape.plants.size() == 1000);
    std::size_t sum = 0, plants = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::uint16_t level = 0; level < 3; ++level) {
            sum += landscape.count(i, level) * species[i].levels[level].triangles.size();
            plants += landscape.count(i, level);
        }
        sum += 2 * landscape.count(i, PlantedPlant::card_level);
        plants += landscape.count(i, PlantedPlant::card_level);
    }
    CHECK(plants == 1000);
    CHECK(landscape.triangles() == sum);
    CHECK(landscape.triangles_in_full() == 1000 * species[0].triangles);
    CHECK(landscape.triangles() < landscape.triangles_in_full() / 2);
}

TEST_CASE("the internodes of a frame are the plants of a stand: place, radius and species by colour", "[landscape]") {
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {4, 0, 5}, {4, 0.3, 5}, 0);
    Internode& internode = plant.interpretation.geometry.internodes.back();
    internode.base_radius = internode.tip_radius = 1.25;
    const std::vector<StandPlant> stand = stand_of(recorded(plant));
    REQUIRE(stand.size() == 1);
    CHECK(stand[0].place == glm::dvec2(4, 5));
    CHECK(stand[0].radius == Approx(1.25));
    plant.interpretation.geometry.internodes.back().base_radius = 0;
    CHECK_THROWS_WITH(stand_of(recorded(plant)), Contains("no radius"));
    CHECK_THROWS_WITH(stand_of(FrameGeometry()), Contains("no plants"));
}
