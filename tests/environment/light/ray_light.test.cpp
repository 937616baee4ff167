#include "catch.h"
#include "environment/light/lit_leaves.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

using std::numbers::pi;

const std::string sun_above = "sky = { par = 1000, diffuse = 0, sun = [0, 1, 0] }\n";

Environment ray_light(const std::string& lines, const std::string& process = "ray-light") {
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 2;
    return environment_of("[light]\nprocess = \"" + process + "\"\n" + lines, context);
}

/// Squares of all directions anywhere in the domain.
void scatter_squares(PlantGeometry& geometry, std::uint32_t module, int count, double side, std::uint64_t seed) {
    RandomSamples samples(RandomKey(seed, 0, Stream::process, 1), 5, 0);
    for (int i = 0; i < count; ++i) {
        const double y = samples.uniform(), turn = 2 * pi * samples.uniform(), across = std::sqrt(1 - y * y);
        const glm::dvec3 normal(across * std::cos(turn), y, across * std::sin(turn));
        const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.4, 0.86)));
        const glm::dvec3 middle(2 * samples.uniform(), 0.05 + 2.9 * samples.uniform(), 2 * samples.uniform());
        draw_square(geometry, module, middle, along, glm::cross(normal, along), side);
    }
}

}  // namespace

TEST_CASE("a level black leaf under the open sky absorbs what falls on it", "[ray-light]") {
    for (const double height : {0.07, 1.3, 55.0}) {
        Environment environment = ray_light(black + sun_above);
        AskingPlants plants;
        plants.add({{{0.2, height, 0.1}, {0, 0, 0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {0.2, height, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.02);
        plants.exchange(environment, 1);
        const std::vector<double> answer = plants.parameters();
        const double error = 4 * statistic(environment, "absorbed_error") + 1e-9;
        CHECK(answer[1] == Approx(0.0004 * 1e-3 * 86400).margin(error));
        CHECK(answer[0] == Approx(1).margin(error / (0.0004 * 86.4)));
        CHECK(answer[2] == Approx(1000 * answer[0]));
    }
}

TEST_CASE("over a soil that reflects a share of the light, a small leaf gets that share from below", "[ray-light]") {
    for (const double soil : {0.1, 0.4}) {
        Environment environment =
            ray_light("periodic = true\npaths = 1000000\nbands.par = { leaf = [0, 0], soil = " + std::to_string(soil) +
                      " }\n" + sun_above);
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.05);
        plants.exchange(environment, 1);
        // The soil around it is lit but for its own shadow, a 1600th of the period.
        CHECK(plants.parameters()[0] == Approx(1 + soil).epsilon(0.04));
    }
}

TEST_CASE("one and two layers of level leaves divide the light as the exact series says", "[ray-light]") {
    const double back = 0.3, through = 0.2;
    for (const int layers : {1, 2}) {
        Environment environment =
            ray_light("periodic = true\nresidual = 1e-6\nbands.par = { leaf = [0.3, 0.2], soil = 0 }\n" + sun_above);
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0}}, {{0, 0, 0}, {0}}});
        for (int layer = 0; layer < layers; ++layer) {
            draw_square(plants.interpretation(0).geometry, 1, {1, 1 + 0.5 * layer, 1}, {1, 0, 0}, {0, 0, 1}, 2);
        }
        plants.exchange(environment, 1);
        const double passed = layers == 1 ? through : through * through / (1 - back * back);
        const double escaped = layers == 1 ? back : back + through * through * back / (1 - back * back);
        CHECK(statistic(environment, "soil") == Approx(passed).margin(0.003));
        CHECK(statistic(environment, "escaped") == Approx(escaped).margin(0.003));
        CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
    }
}

TEST_CASE("an upright plate at the edge of a lit one gets what the view factor of an L says", "[ray-light]") {
    Environment environment =
        ray_light("paths = 1000000\nresidual = 1e-5\nbands.par = { leaf = [0.05, 0], soil = 0 }\n" + sun_above);
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}, {{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    draw_square(geometry, 1, {0.5, 0.5, 0.5}, {1, 0, 0}, {0, 0, 1}, 1);
    draw_square(geometry, 3, {0, 1, 0.5}, {0, 1, 0}, {0, 0, 1}, 1);
    plants.exchange(environment, 1);
    const double factor = 0.20004;  // two unit squares that share an edge (Howell, Siegel & Menguc 2010, C-14)
    // What goes to and fro once more is a ten-thousandth of it.
    CHECK(plants.parameters()[4] == Approx(0.95 * 0.05 * factor * 86.4).epsilon(0.005));
    CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
}

TEST_CASE("random black leaves of a periodic stand let exp(-G LAI / cos zenith) through", "[ray-light]") {
    constexpr double side = 0.008;
    constexpr int count = 100000;
    const double area_index = count * side * side / 4;
    for (const double zenith : {0.0, 0.9}) {
        Environment environment =
            ray_light("periodic = true\npaths = 131072\n" + black + "sky = { par = 500, diffuse = 0, sun = [" +
                      std::to_string(std::sin(zenith)) + ", " + std::to_string(std::cos(zenith)) + ", 0] }\n");
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        scatter_squares(plants.interpretation(0).geometry, 1, count, side, 77 + std::uint64_t(10 * zenith));
        plants.exchange(environment, 1);
        CHECK(statistic(environment, "leaf_area") == Approx(4 * area_index).epsilon(1e-6));
        // The gaps of one stand are a sample of its leaves' places: a standard error of half a percent.
        const double exact = std::exp(-0.5 * area_index / std::cos(zenith));
        CHECK(statistic(environment, "soil") == Approx(exact).epsilon(0.015));
    }
}

TEST_CASE("scattered light is neither lost nor made, in any band", "[ray-light]") {
    Environment environment = ray_light("periodic = true\nbands.par = {}\nbands.nir = { share = 0.4 }\n" + sun_above);
    AskingPlants plants;
    plants.add({{{1, 1, 1}, {0, 0, 0, 0, 0}}, {{0, 0, 0}, {0}}});
    scatter_squares(plants.interpretation(0).geometry, 1, 3000, 0.06, 3);
    plants.exchange(environment, 1);
    CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
    const double par = statistic(environment, "absorbed"), nir = statistic(environment, "absorbed.nir");
    CHECK(plants.parameters()[1] == Approx(par));
    CHECK(plants.parameters()[4] == Approx(nir));
    const double photons = 0.4 * 1100 / 119.627 / (0.5 * 4.57);  // of nir for each of par
    CHECK(nir / photons < 0.6 * par);  // leaves absorb a fifth of it at each meeting, and of PAR four fifths
    CHECK(statistic(environment, "escaped") > 0.01);
}

TEST_CASE("black leaves absorb per organ what a ray tracer without tree or scatter counts", "[ray-light]") {
    constexpr int leaves = 40;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.4, 1, 0.2));
    Environment environment =
        ray_light("paths = 1000000\n" + black + "sky = { par = 1000, diffuse = 0, sun = [0.4, 1, 0.2] }\n");
    AskingPlants plants;
    std::vector<Asked> asked;
    for (int i = 0; i < leaves; ++i) asked.insert(asked.end(), {{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
    plants.add(asked);
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    for (std::uint32_t i = 0; i < leaves; ++i) scatter_squares(geometry, 2 * i + 1, 1, 0.7, 900 + i);
    plants.exchange(environment, 1);

    // Rays from a fine grid on each leaf towards the light, against all squares.
    const auto is_met = [&](const glm::dvec3& from, std::uint32_t own) {
        for (std::uint32_t k = 0; k < leaves; ++k) {
            const glm::dvec3* const v = &geometry.vertices[geometry.polygons[k].first];
            const glm::dvec3 x = v[1] - v[0], y = v[3] - v[0], normal = glm::cross(x, y);
            const double t = glm::dot(v[0] - from, normal) / glm::dot(towards, normal);
            const glm::dvec3 at = from + t * towards - v[0];
            const double a = glm::dot(at, x) / glm::dot(x, x), b = glm::dot(at, y) / glm::dot(y, y);
            if (k != own && t > 0 && a >= 0 && a <= 1 && b >= 0 && b <= 1) return true;
        }
        return false;
    };
    double all = 0, all_counted = 0;
    for (std::uint32_t k = 0; k < leaves; ++k) {
        const glm::dvec3* const v = &geometry.vertices[geometry.polygons[k].first];
        const glm::dvec3 x = v[1] - v[0], y = v[3] - v[0];
        constexpr int grid = 100;
        int lit = 0;
        for (int i = 0; i < grid * grid; ++i) {
            lit += !is_met(v[0] + (i % grid + 0.5) / grid * x + (i / grid + 0.5) / grid * y, k);
        }
        const double across = std::abs(glm::dot(glm::cross(x, y), towards)) / towards.y;
        const double counted = double(lit) / (grid * grid) * across * 86.4;
        const double absorbed = plants.parameters()[3 * k + 1];
        CHECK(absorbed == Approx(counted).margin(0.01 * 0.49 * 86.4));
        all += absorbed;
        all_counted += counted;
    }
    CHECK(all == Approx(all_counted).epsilon(0.003));
}

TEST_CASE("canopy-light and ray-light agree on random black leaves", "[ray-light]") {
    const std::string sky = "periodic = true\nsky = { par = 800, diffuse = 0.6, sun = [0.5, 1, 0.3] }\n";
    Environment rays = ray_light(black + sky), voxels = ray_light("voxel = 0.5\n" + black + sky, "canopy-light");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
    scatter_squares(plants.interpretation(0).geometry, 1, 20000, 0.02, 8);
    plants.exchange(rays, 1);
    plants.exchange(voxels, 1);
    CHECK(statistic(rays, "absorbed") == Approx(statistic(voxels, "absorbed")).epsilon(0.02));
    CHECK(statistic(rays, "incoming") == statistic(voxels, "incoming"));
}

TEST_CASE("one thread and two, plants in any order, and a plant moved by a period absorb the same", "[ray-light]") {
    const auto absorbed = [](int threads, std::uint32_t first, double shift) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        Environment environment = ray_light("periodic = true\n" + sun_above);
        AskingPlants plants;
        for (int i = 0; i < 2; ++i) plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        scatter_squares(plants.interpretation(first).geometry, 1, 300, 0.1, 4);
        scatter_squares(plants.interpretation(1 - first).geometry, 1, 300, 0.1, 5);
        for (glm::dvec3& vertex : plants.interpretation(first).geometry.vertices) vertex.x += shift;
        plants.exchange(environment, 1);
        return std::array{statistic(environment, "absorbed", first), statistic(environment, "absorbed", 1 - first)};
    };
    const auto one = absorbed(1, 0, 0);
    CHECK(absorbed(2, 0, 0) == one);
    CHECK(absorbed(2, 1, 0) == one);
    const auto moved = absorbed(2, 0, 2);
    CHECK(moved[0] == Approx(one[0]).epsilon(1e-3));
    CHECK(moved[1] == Approx(one[1]).epsilon(1e-3));
}

TEST_CASE("a leaf below the ground gets no light, which a warning tells once", "[ray-light]") {
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.plants = 1;
    context.warnings = &warnings;
    const auto absorbed = [&](double height, const std::string& lines) {
        warnings.clear();
        Environment environment =
            environment_of("[light]\nprocess = \"ray-light\"\n" + lines + black + sun_above, context);
        AskingPlants plants;
        plants.add({{{0, height, 0}, {0}}, {{0, height, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {0, height, 0}, {1, 0, 0}, {0, 0, -1}, 0.5);
        for (const int step : {1, 2}) plants.exchange(environment, step);
        return plants.parameters()[0];
    };
    CHECK(absorbed(0, "") == Approx(1).epsilon(0.01));
    CHECK(warnings.empty());
    CHECK(absorbed(-0.001, "") == 0);
    REQUIRE(warnings.size() == 1);
    CHECK(lacks(warnings[0].message, {"step 1", "1 of the organs", "below the ground", "y = 0 m", "'ground'"}) == "");
    CHECK(absorbed(-0.001, "ground = -0.001\n") == Approx(1).epsilon(0.01));
    CHECK(warnings.empty());
}

TEST_CASE("the standard error is that of repeated runs, and falls at least as the root of the paths", "[ray-light]") {
    const auto trial = [](const std::string& lines, int step) {
        Environment environment = ray_light(lines + sun_above);
        AskingPlants plants;
        plants.add({{{0, 0, 0}, {0}}, {{0, 0, 0}, {0}}});
        scatter_squares(plants.interpretation(0).geometry, 1, 200, 0.1, 4);
        plants.exchange(environment, step);
        return std::pair{statistic(environment, "absorbed"), statistic(environment, "absorbed_error")};
    };
    double sum = 0, squares = 0, errors = 0, errors_of_more = 0;
    constexpr int count = 24;
    for (int step = 1; step <= count; ++step) {
        const auto [absorbed, error] = trial("paths = 1024\n", step);
        sum += absorbed;
        squares += absorbed * absorbed;
        errors += error;
        errors_of_more += trial("paths = 65536\n", step).second;
    }
    const double spread = std::sqrt((squares - sum * sum / count) / (count - 1));
    CHECK(errors / count == Approx(spread).epsilon(0.4));
    CHECK(errors_of_more < errors / 8 * 1.3);
    const auto [absorbed, error] = trial("paths = 64\naccuracy = 0.005\n", 3);
    CHECK(error <= 0.005 * absorbed);
}

TEST_CASE("a leaf that lies on the soil gets the light of one a millimetre above it", "[ray-light]") {
    for (const double zenith : {0.0, 0.6, 1.2}) {
        std::vector<double> direct, scattered;
        for (const double height : {0.0, 0.001, -1e-6}) {
            for (const char* leaf : {"[0, 0]", "[0.3, 0.4]"}) {
                Environment environment = ray_light(
                    "periodic = true\npaths = 262144\nresidual = 1e-5\nbands.par = { leaf = " + std::string(leaf) +
                    ", soil = 0.2 }\n" + sun_at(zenith));
                AskingPlants plants;
                plants.add({{{1, height, 1}, {0}}, {{0, 0, 0}, {0}}});
                draw_square(plants.interpretation(0).geometry, 1, {1, height, 1}, {1, 0, 0}, {0, 0, -1}, 1);
                plants.exchange(environment, 1);
                CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
                CHECK(statistic(environment, "escaped") < 1);
                (leaf[1] == '0' && leaf[2] == ',' ? direct : scattered).push_back(plants.parameters()[0]);
            }
        }
        CAPTURE(zenith);
        CHECK(direct[0] == Approx(1).epsilon(0.01));
        CHECK(direct[0] == Approx(direct[1]).epsilon(0.005));
        CHECK(direct[2] == Approx(direct[1]).epsilon(0.005));
        // What passes the leaf and the soil below it reflects: 0.3 (1 + 0.4 0.2 + ...) of the light.
        CHECK(scattered[0] == Approx(0.3 * (1 + 0.4 * 0.2 / (1 - 0.3 * 0.2))).epsilon(0.01));
        CHECK(scattered[0] == Approx(scattered[1]).epsilon(0.01));
        CHECK(scattered[2] == Approx(scattered[1]).epsilon(0.01));
    }
}

TEST_CASE("a leaf of a centimetre gets its light and knows its error in a stand of 10, 200 and 1000 m", "[ray-light]") {
    for (const double width : {10.0, 200.0, 1000.0}) {
        std::vector<Diagnostic> warnings;
        EnvironmentContext context;
        context.domain = Box{{0, 0, 0}, {width, 3, width}};
        context.plants = 2;
        context.warnings = &warnings;
        Environment environment = environment_of(
            "[light]\nprocess = \"ray-light\"\nperiodic = true\npaths = 1024\n"
            "bands.par = { leaf = [0.1, 0.1], soil = 0.1 }\nsky = { par = 1000, diffuse = 0.6, sun = [1, 2, 0] }\n",
            context);
        AskingPlants plants;
        for (const double size : {0.01, width / 2}) {
            const double at = size < 1 ? 0.1 * width : 0.6 * width;
            plants.add({{{at, 1, at}, {0, 0}}, {{0, 0, 0}, {0}}});
            draw_square(plants.interpretation(size > 1).geometry, 1, {at, 1, at}, {1, 0, 0}, {0, 0, -1}, size);
        }
        plants.exchange(environment, 1);
        // It absorbs 0.8 of what comes from above and of what the soil, lit but for the large leaf, sends back.
        CHECK(plants.parameters()[0] == Approx(0.8 * 1.1).epsilon(0.02));
        const double error = environment.organ_values("light.error", 0)->at(1);
        CHECK(error < 0.02 * plants.parameters()[1]);
        CHECK(statistic(environment, "absorbed_error", 0) == Approx(error).margin(1e-9));
        CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
        CHECK(warnings.empty());
    }
}

TEST_CASE("a leaf at the foot of a black chimney sees of the sky what the view factor says", "[ray-light]") {
    for (const double height : {0.2, 0.4, 0.8, 1.6}) {
        Environment environment =
            ray_light("paths = 524288\n" + black + "sky = { par = 1000, radiance = \"uniform\" }\n");
        AskingPlants plants;
        for (int i = 0; i < 2; ++i) plants.add({{{1, 0, 1}, {0, 0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(0).geometry, 1, {1, 0, 1}, {1, 0, 0}, {0, 0, -1}, 0.002);
        for (const glm::dvec3& out : {glm::dvec3(0.1, 0, 0), {-0.1, 0, 0}, {0, 0, 0.1}, {0, 0, -0.1}}) {
            PlantGeometry& geometry = plants.interpretation(1).geometry;
            const glm::dvec3 side = glm::cross(out, glm::dvec3(0, 1, 0)), foot = glm::dvec3(1, 0, 1) + out;
            draw_square(geometry, 1, foot, {1, 0, 0}, {0, 1, 0}, 1);
            glm::dvec3* const corners = &geometry.vertices[geometry.vertices.size() - 4];
            for (int k = 0; k < 4; ++k) {
                corners[k] = foot + (k == 0 || k == 3 ? -1.0 : 1.0) * side + glm::dvec3(0, k < 2 ? 0 : height, 0);
            }
        }
        plants.exchange(environment, 1);
        // Howell, Siegel & Menguc 2010, B-4, for a quarter of the opening.
        const double a = 0.1 / height, p = std::sqrt(1 + a * a), factor = 4 / pi * a / p * std::atan(a / p);
        CAPTURE(height);
        CHECK(plants.parameters()[0] == Approx(factor).epsilon(0.01));
        CHECK(statistic(environment, "absorbed_error", 0) < 0.01 * plants.parameters()[1]);
    }
}

TEST_CASE("light that none of few rays has found has an error of that size", "[ray-light]") {
    // Below a roof with a hole a thousandth of the sky wide, over a soil that sends some light up from the open.
    std::vector<Diagnostic> warnings;
    EnvironmentContext context;
    context.domain = Box{{0, 0, 0}, {2, 3, 2}};
    context.plants = 2;
    context.warnings = &warnings;
    const auto lit = [&](const std::string& lines) {
        warnings.clear();
        Environment environment =
            environment_of("[light]\nprocess = \"ray-light\"\nperiodic = true\n" + lines + black + sun_above, context);
        AskingPlants plants;
        for (const double height : {1.0, 2.0}) {
            plants.add({{{1, height, 1}, {0, 0}}, {{0, 0, 0}, {0}}});
            draw_square(plants.interpretation(height > 1).geometry, 1, {1, height, 1}, {1, 0, 0}, {0, 0, -1},
                        height > 1 ? 1.96 : 1.961);
        }
        plants.exchange(environment, 1);
        return std::pair(statistic(environment, "absorbed", 0), statistic(environment, "absorbed_error", 0));
    };
    const double exact = (1.961 * 1.961 - 1.96 * 1.96) * 86.4;
    const auto [few, unknown] = lit("paths = 64\n");
    CHECK(few < 0.1 * 86.4);
    CHECK((std::isnan(unknown) || unknown > exact / 2));
    const auto [many, error] = lit("paths = 64\naccuracy = 0.05\n");
    CHECK(many == Approx(exact).epsilon(0.2));
    CHECK(error <= 0.05 * many);
}

TEST_CASE("two leaves in one place share the light of one", "[ray-light]") {
    for (const double apart : {0.0, 1e-7}) {
        Environment environment = ray_light(black + sun_at(0.4));
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0, 0}}, {{0, 0, 0}, {0}}, {{1, 1, 1}, {0, 0}}, {{0, 0, 0}, {0}}});
        PlantGeometry& geometry = plants.interpretation(0).geometry;
        draw_square(geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, -1}, 0.3);
        draw_square(geometry, 3, {1, 1 - apart, 1}, {1, 0, 0}, {0, 0, -1}, 0.3);
        plants.exchange(environment, 1);
        CHECK(plants.parameters()[1] + plants.parameters()[4] == Approx(0.09 * 86.4).epsilon(0.01));
    }
}

TEST_CASE("leaves of a large stand absorb when drawn as the light sees them what their rays find", "[ray-light]") {
    constexpr int leaves = 3000;
    const auto lit = [](const std::string& lines, int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        Environment environment = ray_light(lines +
                                            "bands.par = { leaf = [0.2, 0.1], soil = 0.1 }\n"
                                            "sky = { par = 1000, diffuse = 0.4, sun = [1, 2, 0.3] }\n");
        AskingPlants plants;
        std::vector<Asked> asked;
        for (int i = 0; i < leaves; ++i) asked.insert(asked.end(), {{{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {0}}});
        plants.add(asked);
        for (std::uint32_t i = 0; i < leaves; ++i) {
            scatter_squares(plants.interpretation(0).geometry, 2 * i + 1, 1, 0.06, 900 + i);
        }
        plants.exchange(environment, 1);
        std::pair<std::vector<double>, std::vector<double>> light_and_error;
        const auto absorbed = environment.organ_values("light.absorbed", 0),
                   error = environment.organ_values("light.error", 0);
        for (std::size_t i = 1; i < absorbed->size(); i += 2) {
            light_and_error.first.push_back((*absorbed)[i]);
            light_and_error.second.push_back((*error)[i]);
        }
        CHECK(std::abs(statistic(environment, "closure")) < 1e-6);
        return light_and_error;
    };
    for (const char* period : {"", "periodic = true\n"}) {
        const std::string lines = std::string("paths = 8192\n") + period;
        const auto drawn = lit(lines, 1);
        CHECK(lit(lines, 2) == drawn);
        const auto sought = lit(std::string("paths = 524288\n") + period, 2);
        double sum = 0, all = 0, squares = 0, told = 0;
        for (std::size_t i = 0; i < leaves; ++i) {
            sum += drawn.first[i];
            all += sought.first[i];
            squares += std::pow(drawn.first[i] - sought.first[i], 2);
            told += std::pow(drawn.second[i], 2);
        }
        CAPTURE(period);
        CHECK(sum == Approx(all).epsilon(0.015));
        CHECK(std::sqrt(squares / leaves) < 0.25 * all / leaves);
        // Trials that look at other parts of the sky differ more than their mean errs.
        CHECK(std::sqrt(told / squares) > 0.7);
        CHECK(std::sqrt(told / squares) < 2);
    }
}

TEST_CASE("a plant in the dark does not ask for ever more paths", "[ray-light]") {
    Environment environment = ray_light("periodic = true\npaths = 1024\naccuracy = 0.05\n" + black + sun_above);
    AskingPlants plants;
    for (const double height : {1.0, -0.5}) {
        plants.add({{{1, height, 1}, {0, 0}}, {{0, 0, 0}, {0}}});
        draw_square(plants.interpretation(height < 0).geometry, 1, {1, height, 1}, {1, 0, 0}, {0, 0, -1}, 0.5);
    }
    plants.exchange(environment, 1);
    CHECK(statistic(environment, "absorbed", 0) == Approx(0.25 * 86.4).epsilon(0.2));
    CHECK(statistic(environment, "absorbed", 1) == 0);
    CHECK(std::isnan(statistic(environment, "absorbed_error", 1)));
}

TEST_CASE("light of four bands is kept to rounding, however their reflectances and transmittances differ",
          "[ray-light]") {
    for (const char* lines : {"paths = 1024\n", "paths = 1024\nperiodic = true\n", "paths = 1024\nresidual = 1e-5\n",
                              "paths = 1024\nlamps = [{ at = [1, 2.9, 1], photons = 50, photons_nir = 9 }]\n"}) {
        Environment environment =
            ray_light(std::string(lines) +
                      "bands.par = { leaf = [0.1, 0.02], soil = 0.1 }\nbands.nir = { leaf = [0.4, 0.5], soil = 0.3 }\n"
                      "bands.red = { leaf = [0, 0.3], soil = 0 }\nbands.blue = { leaf = [0.05, 0], soil = 0.2, share = "
                      "0.1, wavelength = 450 }\n" +
                      sun_above);
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0}}, {{0, 0, 0}, {0}}});
        scatter_squares(plants.interpretation(0).geometry, 1, 2000, 0.08, 3);
        plants.exchange(environment, 1);
        for (const char* band : {"closure", "closure.nir", "closure.red", "closure.blue"}) {
            CHECK(std::abs(statistic(environment, band)) < 1e-6);
        }
    }
}

TEST_CASE("each of several bands is absorbed as it is alone", "[ray-light]") {
    const auto absorbed = [](const std::string& bands, const std::string& name) {
        Environment environment = ray_light("periodic = true\npaths = 131072\n" + bands + sun_above);
        AskingPlants plants;
        plants.add({{{1, 1, 1}, {0}}, {{0, 0, 0}, {0}}});
        scatter_squares(plants.interpretation(0).geometry, 1, 2000, 0.08, 3);
        plants.exchange(environment, 1);
        return statistic(environment, name);
    };
    const std::string par = "bands.par = { leaf = [0.3, 0.02], soil = 0.1 }\n",
                      nir = "bands.nir = { leaf = [0.2, 0.6], soil = 0.3 }\n";
    CHECK(absorbed(par + nir, "absorbed") == Approx(absorbed(par, "absorbed")).epsilon(0.004));
    CHECK(absorbed(par + nir, "absorbed.nir") ==
          Approx(absorbed("bands.par = { leaf = [0, 0], soil = 0 }\n" + nir, "absorbed.nir")).epsilon(0.006));
}

TEST_CASE("step 0 answers shares and rates, and spends no light", "[ray-light]") {
    for (const char* process : {"ray-light", "canopy-light"}) {
        Environment environment = ray_light(black + "sky = { par = 1000, diffuse = 1 }\n", process);
        double share = 0, rate = 0;
        for (int step = 0; step < 3; ++step) {
            AskingPlants plants;
            plants.add({{{1, 1, 1}, {0, 9, 0}}, {{0, 0, 0}, {0}}});
            draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, -1}, 0.5);
            plants.exchange(environment, step);
            const std::vector<double> answer = plants.parameters();
            if (step == 0) share = answer[0], rate = answer[2];
            CHECK(share > 0.7);
            CHECK(answer[0] == Approx(share).epsilon(0.05));
            CHECK(answer[2] == Approx(rate).epsilon(0.05));
            CHECK((answer[1] > 0) == (step > 0));
            CHECK((statistic(environment, "absorbed") > 0) == (step > 0));
            CHECK(statistic(environment, "incoming") == Approx(step > 0 ? 86.4 : 0));
            CHECK((environment.organ_values("light.absorbed", 0)->at(1) > 0) == (step > 0));
            CHECK(environment.organ_values("light.flux", 0)->at(1) > 700);
        }
    }
}

TEST_CASE("in a dark step f stays what it was, or is 0 by choice; e and m are 0", "[ray-light]") {
    for (const char* process : {"ray-light", "canopy-light"}) {
        for (const auto& [dark, kept] : {std::pair{"dark = \"zero\"\n", 0.0}, {"dark = \"keep\"\n", 0.7}, {"", 0.7}}) {
            Environment environment = ray_light(std::string(dark) +
                                                    "sky = { latitude = 80, day = 355 }\n"
                                                    "bands.par = {}\nbands.nir = {}\n",
                                                process);
            AskingPlants plants;
            plants.add({{{1, 1, 1}, {0.7, 0.7, 0.7, 0.7, 0.7, 0.7}}, {{0, 0, 0}, {0}}});
            draw_square(plants.interpretation(0).geometry, 1, {1, 1, 1}, {1, 0, 0}, {0, 0, -1}, 0.5);
            plants.exchange(environment, 1);
            const std::vector<double> answer = plants.parameters();
            for (const std::size_t band : {0, 3}) {
                CHECK(answer[band] == kept);
                CHECK(answer[band + 1] == 0);
                CHECK(answer[band + 2] == 0);
            }
        }
    }
}

TEST_CASE("optical numbers that cannot be are refused in words", "[ray-light]") {
    const auto message = [](const std::string& lines) { return message_of([&] { ray_light(lines); }); };
    CHECK(lacks(message("bands.par = { leaf = [0.7, 0.4] }\n"), {"scene.toml", "1 together at most"}) == "");
    CHECK(lacks(message("bands.par = { leaf = [0.7] }\n"), {"[reflectance, transmittance]"}) == "");
    CHECK(lacks(message("bands.red = { soil = 0.1 }\n"), {"the band 'red' needs leaf"}) == "");
    CHECK(lacks(message("paths = 1\n"), {"paths"}) == "");
}
