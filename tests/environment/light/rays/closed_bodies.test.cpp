// Spheres and closed cylinders in light, against rays that are met by the round shapes themselves.
#include "espalier/geometry/generalized_cylinder.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"

#include <array>

using namespace espalier;

namespace {

void draw_sphere(PlantGeometry& geometry, std::uint32_t module, const glm::dvec3& middle, double diameter) {
    Organ& sphere = geometry.organs.emplace_back();
    sphere.module = module;
    sphere.shape = Organ::Shape::sphere;
    sphere.size = {diameter, 0, 0};
    sphere.sides = 16;
    sphere.pose.position = middle;
}

void draw_cylinder(PlantGeometry& geometry, std::uint32_t module, const glm::dvec3& from, const glm::dvec3& to,
                   double width) {
    GeneralizedCylinder cylinder;
    cylinder.sides = 64;
    const glm::dvec3 along = glm::normalize(to - from),
                     across = glm::normalize(glm::cross(along, glm::dvec3(0.3, 0.5, 0.8)));
    for (const glm::dvec3& at : {from, to}) {
        CylinderPoint& point = cylinder.points.emplace_back();
        point.module = module;
        point.pose = {at, along, glm::cross(along, across), across};
        point.width = width;
    }
    draw(cylinder, geometry);
}

/// `count` modules that ask for the light of the ones behind them: modules 1, 3, 5, ...
AskingPlants asking_for(int count) {
    std::vector<Asked> asked;
    for (int i = 0; i < count; ++i) asked.insert(asked.end(), {{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
    AskingPlants plants;
    plants.add(asked);
    return plants;
}

/// m2 of level ground whose light the module behind query `number` absorbs, of 86.4 mol m-2.
double absorbed(const AskingPlants& plants, int number) {
    return plants.parameters()[3 * static_cast<std::size_t>(number) + 1] / 86.4;
}

struct Ball {
    glm::dvec3 middle;
    double radius;

    bool is_met(const glm::dvec3& from, const glm::dvec3& towards) const {
        const glm::dvec3 to = middle - from;
        const double along = glm::dot(to, towards), apart = glm::dot(to, to);
        return apart < radius * radius || (along > 0 && apart - along * along < radius * radius);
    }
};

}  // namespace

TEST_CASE("a black sphere and a black cylinder absorb what their outlines take from parallel light",
          "[ray-light][canopy-light]") {
    for (const double zenith : {0.0, 0.6, 1.1}) {
        for (const auto& [process, lines, error] :
             {std::tuple{"ray-light", "paths = 262144\nground = -3\n", 0.01}, {"canopy-light", "voxel = 2\n", 0.02}}) {
            const double from_above = 1 / std::cos(zenith);
            {
                Environment light = light_process(process, black + lines + sun_at(zenith));
                AskingPlants plants = asking_for(1);
                draw_sphere(plants.interpretation(0).geometry, 1, {0.7, 1, 0.9}, 0.2);
                plants.exchange(light, 1);
                const double outline = std::numbers::pi * 0.01;
                CHECK(absorbed(plants, 0) == Approx(outline * from_above).epsilon(error));
                CHECK(plants.parameters()[0] == Approx(0.5 * from_above).epsilon(error));  // per half the surface
            }
            Environment light = light_process(process, black + lines + sun_at(zenith));
            AskingPlants plants = asking_for(1);
            draw_cylinder(plants.interpretation(0).geometry, 1, {0.7, 1, 0.9}, {0.7, 1.8, 0.9}, 0.1);
            plants.exchange(light, 1);
            const double outline =
                0.8 * 0.1 * std::sin(zenith) + std::numbers::pi * 0.0025 * std::cos(zenith);  // mantle and one end
            CHECK(absorbed(plants, 0) == Approx(outline * from_above).epsilon(error));
        }
    }
}

TEST_CASE("spheres shade leaves and each other as rays against balls count", "[ray-light]") {
    constexpr int count = 20;
    const double zenith = 0.5;
    const glm::dvec3 towards(std::sin(zenith), std::cos(zenith), 0);
    RandomSamples samples(RandomKey(2718, 0, Stream::process, 1), 5, 0);
    AskingPlants plants = asking_for(count + 1);
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 middle(samples.uniform(), 1 + samples.uniform(), samples.uniform());
        balls.push_back({middle, 0.05 + 0.15 * samples.uniform()});
        draw_sphere(geometry, static_cast<std::uint32_t>(2 * i + 1), middle, 2 * balls.back().radius);
    }
    const glm::dvec3 leaf(0.2, 0.5, 0.5);
    draw_square(geometry, 2 * count + 1, leaf, {1, 0, 0}, {0, 0, 1}, 1);
    Environment light = light_process("ray-light", black + "paths = 524288\nground = -3\n" + sun_at(zenith));
    plants.exchange(light, 1);

    const auto is_met = [&](const glm::dvec3& from, int own) {
        for (int k = 0; k < count; ++k) {
            if (k != own && balls[static_cast<std::size_t>(k)].is_met(from, towards)) return true;
        }
        return false;
    };
    constexpr int grid = 200;
    const glm::dvec3 x(towards.y, -towards.x, 0), z(0, 0, 1);
    double shaded_leaf = 0;
    for (int i = 0; i < grid * grid; ++i) {
        const glm::dvec3 at = leaf + glm::dvec3((i % grid + 0.5) / grid - 0.5, 0, (i / grid + 0.5) / grid - 0.5);
        shaded_leaf += is_met(at, count) ? 1.0 : 0.0;
    }
    CHECK(absorbed(plants, count) == Approx(1 - shaded_leaf / (grid * grid)).margin(0.01));
    CHECK(absorbed(plants, count) < 0.8);
    for (int k = 0; k < count; ++k) {
        const Ball& ball = balls[static_cast<std::size_t>(k)];
        int lit = 0;
        for (int i = 0; i < grid * grid; ++i) {  // rays through the outline of the ball, from its near half on
            const double u = (i % grid + 0.5) / grid * 2 - 1, v = (i / grid + 0.5) / grid * 2 - 1,
                         w = 1 - u * u - v * v;
            if (w < 0) continue;
            lit += !is_met(ball.middle + ball.radius * (u * x + v * z + std::sqrt(w) * towards), k);
        }
        const double outline = 4 * ball.radius * ball.radius * lit / (grid * grid);
        CHECK(absorbed(plants, k) == Approx(outline / towards.y).margin(0.003));
    }
}

TEST_CASE("random spheres of a periodic stand let exp(-outlines per ground / cos zenith) through",
          "[ray-light][canopy-light]") {
    constexpr int count = 20000;
    constexpr double diameter = 0.016;
    for (const auto& [process, lines] :
         {std::pair{"ray-light", "paths = 131072\n"}, {"canopy-light", "voxel = 0.5\n"}}) {
        Environment light = light_process(process, black + "periodic = true\n" + lines + sun_at(0.6));
        AskingPlants plants = asking_for(1);
        RandomSamples samples(RandomKey(31, 0, Stream::process, 1), 5, 0);
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 middle(2 * samples.uniform(), 0.02 + 2.96 * samples.uniform(), 2 * samples.uniform());
            draw_sphere(plants.interpretation(0).geometry, 1, middle, diameter);
            plants.interpretation(0).geometry.organs.back().sides = 6;
        }
        plants.exchange(light, 1);
        const double outlines = count * std::numbers::pi * diameter * diameter / 4 / 4;
        // The gaps of one stand are a sample of its spheres' places: a standard error of 0.0033.
        CHECK(statistic(light, "soil") == Approx(std::exp(-outlines / std::cos(0.6))).margin(0.01));
        CHECK(statistic(light, "leaf_area") == 0);
        CHECK(std::abs(statistic(light, "closure")) < 1e-6);
    }
}

TEST_CASE("a grey sphere sends back its share of the light and lets nothing through", "[ray-light][canopy-light]") {
    for (const auto& [process, lines, error] :
         {std::tuple{"ray-light", "paths = 262144\nground = -3\n", 0.01}, {"canopy-light", "voxel = 2\n", 0.02}}) {
        Environment light =
            light_process(process, "bands.par = { stem = 0.4, soil = 0 }\n" + std::string(lines) + sun_at(0.4));
        AskingPlants plants = asking_for(1);
        draw_sphere(plants.interpretation(0).geometry, 1, {0.7, 1, 0.9}, 0.2);
        plants.exchange(light, 1);
        const double met = std::numbers::pi * 0.01 / std::cos(0.4);
        CHECK(absorbed(plants, 0) == Approx(0.6 * met).epsilon(error));
    }
}
