#include "catch.h"
#include "environment/light/lit_leaves.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

using std::numbers::pi;

const std::string sun_at_zenith = "sky = { par = 1000, diffuse = 0, sun = [0, 1, 0] }\n";

Environment canopy_light(const std::string& lines, const Box& domain = {{0, 0, 0}, {2, 3, 2}}) {
    EnvironmentContext context;
    context.domain = domain;
    context.plants = 2;
    return environment_of("[light]\nprocess = \"canopy-light\"\n" + black + lines, context);
}

}  // namespace

TEST_CASE("a level leaf under the open sky absorbs what falls on it", "[canopy-light]") {
    for (const double height : {0.07, 1.3, 55.0}) {
        Environment environment = canopy_light("voxel = 0.5\n" + sun_at_zenith);
        AskingPlants plants;
        plants.add({{{0.2, height, 0.1}, {0, 0, 0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {0.2, height, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.02);
        plants.exchange(environment, 1);
        const std::vector<double> answer = plants.parameters();
        const double self_shaded = (1 - std::exp(-0.0016)) / 0.0016;  // 0.0004 m2 in 0.25 m2
        CHECK(answer[0] == Approx(self_shaded).epsilon(1e-6));
        CHECK(answer[1] == Approx(self_shaded * 0.0004 * 1e-3 * 86400).epsilon(1e-6));
        CHECK(answer[2] == Approx(1000 * self_shaded).epsilon(1e-6));
    }
}

TEST_CASE("random leaves of a periodic canopy absorb 1 - exp(-G LAI / cos zenith) of the light", "[canopy-light]") {
    constexpr double side = 0.02;
    constexpr int count = 30000;  // 12 m2 over 4 m2
    for (const double zenith : {0.0, 0.7, 1.2}) {
        for (const double voxel : {1.0, 0.5}) {
            Environment environment = canopy_light(
                "voxel = " + std::to_string(voxel) + "\nperiodic = true\nsky = { par = 500, diffuse = 0, sun = [" +
                std::to_string(std::sin(zenith)) + ", " + std::to_string(std::cos(zenith)) + ", 0] }\n");
            AskingPlants plants;
            plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
            RandomSamples samples(RandomKey(77, 0, Stream::process, 1), 5, 0);
            for (int i = 0; i < count; ++i) {
                const double y = samples.uniform(), turn = 2 * pi * samples.uniform(), across = std::sqrt(1 - y * y);
                const glm::dvec3 normal(across * std::cos(turn), y, across * std::sin(turn));
                const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.4, 0.86)));
                const glm::dvec3 middle(2 * samples.uniform(), 0.001 + 2.998 * samples.uniform(),
                                        2 * samples.uniform());
                draw_square(plants.interpretation(0).geometry, 1, middle, along, glm::cross(normal, along), side);
            }
            plants.exchange(environment, 1);
            const double exact = std::exp(-0.5 * 3 / std::cos(zenith));
            // Voxels of random density let through more than their mean does, by half of the variance.
            CHECK(statistic(environment, "passed") == Approx(exact).epsilon(0.02));
            CHECK(statistic(environment, "leaf_area") == Approx(12).epsilon(1e-6));
            const double incoming = 4 * statistic(environment, "incoming");
            CHECK(statistic(environment, "absorbed") / incoming ==
                  Approx(1 - statistic(environment, "passed")).epsilon(1e-6));
            CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
        }
    }
}

TEST_CASE("queries that bring their leaf area share the light of a layer of that area", "[canopy-light]") {
    Environment environment =
        canopy_light("voxel = 1\narea = \"queries\"\nleaf_angles = \"horizontal\"\nperiodic = true\n" + sun_at_zenith);
    std::vector<Asked> asked;
    for (const double y : {0.5, 1.5, 2.5}) {
        for (const double x : {0.5, 1.5}) {
            for (const double z : {0.5, 1.5}) asked.push_back({{x, y, z}, {0.8, 0, 0}});
        }
    }
    AskingPlants plants;
    plants.add(asked).exchange(environment, 1);
    const std::vector<double> answer = plants.parameters();
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const double above = std::exp(-0.8 * (2.5 - asked[i].position.y));
        CHECK(answer[3 * i] == 0.8);
        CHECK(answer[3 * i + 1] == Approx(above * (1 - std::exp(-0.8)) / 0.8).epsilon(1e-6));
        CHECK(answer[3 * i + 2] == Approx(answer[3 * i + 1] * 0.8 * 86.4).epsilon(1e-6));
    }
    CHECK(statistic(environment, "passed") == Approx(std::exp(-2.4)).epsilon(1e-6));
}

TEST_CASE("leaves of several plants absorb the same as leaves of one, in any order", "[canopy-light]") {
    const std::vector<Asked> first{{{0.1, 0.3, 0.2}, {0.03, 0}}, {{0.3, 0.9, 0.1}, {0.05, 0}}};
    const std::vector<Asked> second{{{0.2, 0.6, 0.2}, {0.04, 0}}};
    const std::string lines = "area = \"queries\"\nsky = { latitude = 40, day = 150 }\n";
    Environment one = canopy_light(lines), two = canopy_light(lines);
    AskingPlants alone, apart;
    alone.add({first[0], first[1], second[0]}).exchange(one, 1);
    apart.add(second).add(first).exchange(two, 1);
    CHECK(alone.parameters()[1] == Approx(apart.parameters(1)[1]).epsilon(1e-12));
    CHECK(alone.parameters()[3] == Approx(apart.parameters(1)[3]).epsilon(1e-12));
    CHECK(alone.parameters()[5] == Approx(apart.parameters(0)[1]).epsilon(1e-12));
}

TEST_CASE("a day of half clearness at 50 degrees brings what the sun's path and half of its light make",
          "[canopy-light]") {
    Environment environment = canopy_light("sky = { latitude = 50, day = 172, year = 2025 }\n");
    AskingPlants plants;
    plants.add({{{0, 1, 0}, {0}}}).exchange(environment, 1);
    // The daily light above the air in closed form (Spencer 1971; Iqbal 1983, equation 4.2.22), declination 23.44.
    const double phi = 50 * pi / 180, declination = 23.44 * pi / 180;
    const double sunset = std::acos(-std::tan(phi) * std::tan(declination));
    const double joules =
        86400 / pi * 1361 / (1.0163 * 1.0163) *
        (sunset * std::sin(phi) * std::sin(declination) + std::cos(phi) * std::cos(declination) * std::sin(sunset));
    CHECK(statistic(environment, "incoming") == Approx(0.5 * joules * 0.5 * 4.57e-6).epsilon(0.01));
    CHECK(plants.parameters()[0] > 0.4);  // a spherical leaf: half of diffuse light times pi / 2, and more of low sun
    CHECK(plants.parameters()[0] < 1.2);
}

TEST_CASE("light that cannot be is refused in words", "[canopy-light]") {
    const auto message = [](const std::string& lines) { return message_of([&] { canopy_light(lines); }); };
    CHECK(lacks(message("sky = { par = 1000, diffuse = 0.5, sun = [1, 0, 0] }\n"), {"2 degrees above"}) == "");
    CHECK(lacks(message("sky = { north = [0, 1, 0] }\n"), {"must be horizontal"}) == "");
    CHECK(lacks(message("sky = { hours = [12, 9] }\n"), {"must rise"}) == "");
    CHECK(lacks(message("sky = { hours = [] }\n"), {"at least one hour"}) == "");
    CHECK(lacks(message("sky = { radiance = \"cie-16\" }\n"), {"cie-15"}) == "");
    CHECK(lacks(message("voxel = 0.3\nperiodic = true\n"), {"whole number of voxels"}) == "");
    CHECK(lacks(message("leaf_angles = \"flat\"\n"), {"planophile"}) == "");
    Environment environment = canopy_light("area = \"queries\"\n");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {-1, 0}}});
    CHECK(lacks(message_of([&] { plants.exchange(environment, 1); }), {"must be a number from 0 on"}) == "");
}

TEST_CASE("a night brings no light, and asks for none", "[canopy-light]") {
    Environment environment = canopy_light("sky = { latitude = 80, day = 355 }\n");
    AskingPlants plants;
    plants.add({{{0, 1, 0}, {7, 7, 7}}}).exchange(environment, 1);
    CHECK(plants.parameters() == std::vector<double>{7, 0, 0});
    CHECK(statistic(environment, "incoming") == 0);
}

TEST_CASE("a leaf wider than its voxels shades itself there, one much smaller does not", "[canopy-light]") {
    const auto share = [](const std::string& voxel) {
        Environment environment = canopy_light("voxel = " + voxel + "\n" + sun_at_zenith);
        AskingPlants plants;
        plants.add({{{0.6, 1.05, 0.8}, {0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {0.6, 1.05, 0.8}, {1, 0, 0}, {0, 0, 1}, 0.4);
        plants.exchange(environment, 1);
        return plants.parameters()[0];
    };
    // (1 - exp(-x)) / x, where a layer of voxels holds x of leaf area.
    for (const char* voxel : {"0.2", "0.1", "0.05"}) CHECK(share(voxel) == Approx(1 - std::exp(-1.0)).epsilon(1e-5));
    CHECK(share("8") == Approx((1 - std::exp(-0.0025)) / 0.0025).epsilon(1e-5));
}

TEST_CASE("larger voxels smooth a clump of leaves away, and absorb more", "[canopy-light]") {
    double before = 0;
    for (const char* voxel : {"0.1", "0.25", "0.5", "1"}) {
        Environment environment = canopy_light("periodic = true\nvoxel = " + std::string(voxel) + "\n" + sun_at_zenith);
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        RandomSamples samples(RandomKey(3, 0, Stream::process, 1), 5, 0);
        for (int i = 0; i < 2000; ++i) {  // 0.8 m2 above 0.16 m2
            const glm::dvec3 middle(0.8 + 0.4 * samples.uniform(), 1 + 0.4 * samples.uniform(),
                                    0.8 + 0.4 * samples.uniform());
            draw_square(plants.interpretation(0).geometry, 1, middle, {1, 0, 0}, {0, 0, 1}, 0.02);
        }
        plants.exchange(environment, 1);
        CHECK(statistic(environment, "absorbed") > before);
        before = statistic(environment, "absorbed");
    }
}
