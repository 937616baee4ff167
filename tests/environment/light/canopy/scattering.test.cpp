#include "catch.h"
#include "environment/light/lit_leaves.h"

#include <array>

using namespace espalier;
using namespace espalier::environment;

namespace {

using std::numbers::pi;

std::string band(double reflected, double transmitted, double soil, const std::string& name = "par") {
    return "bands." + name + " = { leaf = [" + std::to_string(reflected) + ", " + std::to_string(transmitted) +
           "], soil = " + std::to_string(soil) + " }\n";
}

/// Leaf area given by queries, the same in each voxel of 0.25 m of the domain.
AskingPlants even_leaves(double area_index) {
    std::vector<Asked> asked;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 12; ++y) {
            for (int z = 0; z < 8; ++z) {
                asked.push_back({0.25 * glm::dvec3(x + 0.5, y + 0.5, z + 0.5), {area_index * 4 / (8 * 12 * 8), 0}});
            }
        }
    }
    AskingPlants plants;
    plants.add(asked);
    return plants;
}

const std::string by_queries = "voxel = 0.25\nperiodic = true\narea = \"queries\"\n";

}  // namespace

TEST_CASE("leaves of five distributions let exp(-G LAI / cos zenith) through from five zeniths", "[canopy-light]") {
    for (const char* name : {"spherical", "planophile", "erectophile", "plagiophile", "uniform"}) {
        for (const double zenith : {0.0, 0.35, 0.7, 1.05, 1.3}) {
            Environment light = light_process(
                "canopy-light", by_queries + black + sun_at(zenith) + "leaf_angles = \"" + std::string(name) + "\"\n");
            even_leaves(3).exchange(light, 1);
            const double exact = std::exp(-plain_projection(name, zenith) * 3 / std::cos(zenith));
            CHECK(statistic(light, "passed") == Approx(exact).epsilon(0.005));
            CHECK(std::abs(statistic(light, "closure")) < 1e-6);
        }
    }
}

TEST_CASE("of the light of a sky, leaves let the integral over the hemisphere through", "[canopy-light]") {
    for (const auto& [radiance, weight] : {std::pair{"uniform", 0.0}, {"overcast", 2.0}}) {
        Environment light =
            light_process("canopy-light", by_queries + black + "sky = { par = 1000, rings = 12, radiance = \"" +
                                              std::string(radiance) + "\" }\n");
        even_leaves(2).exchange(light, 1);
        double through = 0, all = 0;
        for (int i = 0; i < 20000; ++i) {
            const double zenith = pi / 2 * (i + 0.5) / 20000;
            const double flux = (1 + weight * std::cos(zenith)) * std::cos(zenith) * std::sin(zenith);
            through += flux * std::exp(-0.5 * 2 / std::cos(zenith));
            all += flux;
        }
        CHECK(statistic(light, "passed") == Approx(through / all).epsilon(0.005));
    }
}

TEST_CASE("horizontal leaves divide light as the two-stream equations say exactly", "[canopy-light]") {
    for (const auto& [area_index, r, t, s] :
         {std::array{1.0, 0.08, 0.05, 0.15}, {3.0, 0.45, 0.42, 0.25}, {6.0, 0.3, 0.1, 0.6}, {4.0, 0.5, 0.45, 0.0}}) {
        Environment light =
            light_process("canopy-light", by_queries + band(r, t, s) + sun_at(0.4) +
                                              "leaf_angles = \"horizontal\"\nscattering.residual = 1e-4\n");
        even_leaves(area_index).exchange(light, 1);
        const TwoStreams exact(area_index, r, t, s);
        CHECK(statistic(light, "soil") == Approx((1 - s) * exact.down).margin(0.004));
        CHECK(statistic(light, "escaped") == Approx(exact.up).margin(0.004));
        CHECK(std::abs(statistic(light, "closure")) < 1e-6);
    }
}

TEST_CASE("the error of scattered light falls with the square of the leaf area in a layer of voxels",
          "[canopy-light]") {
    for (const auto& [area_index, r, t, s] : {std::array{6.0, 0.6, 0.1, 0.0}, {8.0, 0.4, 0.5, 0.3}}) {
        const TwoStreams exact(area_index, r, t, s);
        const auto error = [&, r = r, t = t, s = s, area_index = area_index](const std::string& voxel) {
            Environment light = light_process(
                "canopy-light", "voxel = " + voxel + "\nperiodic = true\narea = \"queries\"\n" + band(r, t, s) +
                                    sun_at(0.7) + "leaf_angles = \"horizontal\"\nscattering.residual = 1e-4\n");
            even_leaves(area_index).exchange(light, 1);
            return std::abs(statistic(light, "escaped") - exact.up);
        };
        const double coarse = error("0.5"), fine = error("0.25");  // 6 and 12 layers
        CHECK(coarse < 0.022);
        CHECK(fine < 0.006);
        CHECK(coarse > 3.5 * fine);
    }
}

TEST_CASE("leaves at random come as near to the two-stream equations, if a voxel holds eight of them",
          "[canopy-light]") {
    constexpr double area_index = 2.9, r = 0.4, t = 0.35, s = 0.1;
    constexpr int leaves = 12000;
    const TwoStreams exact(area_index, r, t, s);
    for (const auto& [voxel, error] : {std::pair{"0.2", 0.003}, {"0.1", 0.009}}) {  // eight leaves, one
        Environment light = light_process(
            "canopy-light", std::string("periodic = true\nscattering = { residual = 1e-3 }\nvoxel = ") + voxel +
                                "\nbands.par = { leaf = [0.4, 0.35], soil = 0.1 }\n" + sun_at(0.81));
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        RandomSamples samples(RandomKey(4712, 0, Stream::process, 1), 5, 0);
        for (int i = 0; i < leaves; ++i) {
            const double x = samples.uniform(), y = samples.uniform(), z = samples.uniform();
            draw_square(plants.interpretation(0).geometry, 1, {2 * x, 0.02 + 2.9 * y, 2 * z}, {1, 0, 0}, {0, 0, -1},
                        std::sqrt(4 * area_index / leaves));
        }
        plants.exchange(light, 1);
        CAPTURE(voxel);
        CHECK(statistic(light, "soil") == Approx((1 - s) * exact.down).margin(error));
        CHECK(statistic(light, "escaped") == Approx(exact.up).margin(error));
    }
}

TEST_CASE("drawn leaves, stems, soil and solids keep all light in every band", "[canopy-light]") {
    for (const char* periodic : {"true", "false"}) {
        Environment light =
            light_process("canopy-light", "voxel = 0.2\nperiodic = " + std::string(periodic) +
                                              "\nbands.par = {}\nbands.nir = {}\nclumping = 0.8\n"
                                              "solids = [{ shape = 'box', lower = [0.5, 0, 0.5], upper = [1, 1, 1] }]\n"
                                              "sky = { par = 900, diffuse = 0.4, sun = [1, 2, 0.5] }\n");
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0, 0, 0, 0, 0}}, {{0, 0, 0}, {0}}});
        PlantGeometry& geometry = plants.interpretation(0).geometry;
        draw_at_random(geometry, 1, 4000, 0.05, 3, "planophile");
        Internode stem{};
        stem.module = 1;
        stem.base = {1.5, 0, 1.5};
        stem.tip = {1.5, 2.5, 1.5};
        stem.base_radius = stem.tip_radius = 0.03;
        geometry.internodes.push_back(stem);
        plants.exchange(light, 1);
        for (const char* name : {"closure", "closure.nir"}) CHECK(std::abs(statistic(light, name)) < 1e-6);
        CHECK(statistic(light, "solids") > 0.005);
        CHECK(statistic(light, "absorbed.nir") < 0.7 * statistic(light, "absorbed") * 2);
        CHECK(plants.parameters()[1] == Approx(statistic(light, "absorbed")));
    }
}

TEST_CASE("in slabs of random leaves both processes agree within 2 % in PAR and NIR", "[canopy-light][ray-light]") {
    for (const char* inclination : {"spherical", "planophile"}) {
        const std::string lines = "periodic = true\n" + band(0.08, 0.05, 0.15) + band(0.45, 0.42, 0.25, "nir") +
                                  "sky = { par = 1000, diffuse = 0.3, sun = [0.6, 1, 0.2] }\n";
        Environment voxels = light_process("canopy-light", "voxel = 0.5\n" + lines);
        Environment rays = light_process("ray-light", "paths = 65536\n" + lines);
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        draw_at_random(plants.interpretation(0).geometry, 1, 12000, 0.031, 8, inclination);  // LAI 2.9
        plants.exchange(voxels, 1);
        plants.exchange(rays, 1);
        CAPTURE(inclination);
        for (const char* name : {"absorbed", "absorbed.nir"}) {
            CHECK(statistic(voxels, name) == Approx(statistic(rays, name)).epsilon(0.02));
        }
        for (const char* name : {"soil", "escaped", "soil.nir", "escaped.nir"}) {
            CHECK(statistic(voxels, name) == Approx(statistic(rays, name)).margin(0.01));
        }
    }
}

TEST_CASE("turned about the vertical, moved by a voxel or divided among plants, leaves absorb the same",
          "[canopy-light]") {
    const auto absorbed = [](const glm::dvec3& shift, bool turned, bool divided) {
        const std::string sun = turned ? "[0.2, 1, -0.6]" : "[0.6, 1, 0.2]";
        Environment light =
            light_process("canopy-light", "voxel = 0.25\nsky = { par = 1000, diffuse = 0.5, sun = " + sun +
                                              " }\nscattering = { around = 8 }\n");
        AskingPlants plants;
        const glm::dvec3 middle = glm::dvec3(1, 1, turned ? -1 : 1) + shift;
        for (int i = 0; i < 2; ++i) plants.add({{middle, {0}}, {middle, {0}}});
        draw_at_random(plants.interpretation(0).geometry, 1, 500, 0.08, 4);
        draw_at_random(plants.interpretation(divided ? 1 : 0).geometry, 1, 500, 0.08, 5);
        for (int i = 0; i < 2; ++i) {
            for (glm::dvec3& vertex : plants.interpretation(std::size_t(i)).geometry.vertices) {
                if (turned) vertex = {vertex.z, vertex.y, -vertex.x};
                vertex += shift;
            }
        }
        plants.exchange(light, 1);
        return statistic(light, "absorbed", 0) + statistic(light, "absorbed", 1);
    };
    const double as_drawn = absorbed({0, 0, 0}, false, false);
    CHECK(absorbed({0.5, 0, -0.75}, false, false) == Approx(as_drawn).epsilon(1e-6));
    CHECK(absorbed({0, 0, 0}, false, true) == Approx(as_drawn).epsilon(1e-6));
    CHECK(absorbed({0, 0, 0}, true, false) == Approx(as_drawn).epsilon(1e-6));
}

TEST_CASE("clumped leaves let exp(-clumping G LAI) through", "[canopy-light]") {
    Environment light = light_process("canopy-light", by_queries + black + sun_at(0) + "clumping = 0.6\n");
    even_leaves(4).exchange(light, 1);
    CHECK(statistic(light, "passed") == Approx(std::exp(-0.6 * 0.5 * 4)).epsilon(1e-4));
}
