#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::vector<double> answers_of_shadowpyramid(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"shadowpyramid\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

}  // namespace

TEST_CASE("a caster has 0.42 itself, 0.668 one unit below and 0.916 two below, as measured", "[shadowpyramid]") {
    const std::vector<double> light =
        answers_of_shadowpyramid("", {{{0, 0, 0}, {1}}, {{0, -1, 0}, {0}}, {{0, -2, 0}, {0}}, {{0, 3, 0}, {0}}});
    CHECK(light[0] == Approx(0.42).epsilon(1e-6));
    CHECK(light[1] == Approx(0.668).margin(5e-4));
    CHECK(light[2] == Approx(0.916).margin(5e-4));
    CHECK(light[3] == 1);
}

TEST_CASE("layer i has (2i + 1)^2 voxels times 1 - a b^-d, and the shadows of two multiply", "[shadowpyramid]") {
    Environment environment = environment_of("[light]\nprocess = \"shadowpyramid\"\nshadow_depth = 4\n");
    AskingPlants plants;
    plants.add({{{4, 10, -6}, {1}}, {{4, 10, -6}, {2}}}).exchange(environment);
    const auto& grid = *environment.fields().need("light").grid->grid;
    CHECK(grid.activeVoxelCount() == 1 + 9 + 25 + 49);
    int wrong = 0;
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        const openvdb::Coord at = value.getCoord() - openvdb::Coord(2, 5, -3);
        const double away = std::sqrt(double(at.x() * at.x() + at.y() * at.y() + at.z() * at.z()));
        wrong += std::abs(*value - std::pow(1 - 0.58 * std::pow(6.9, -away), 2)) > 1e-6;
    }
    CHECK(wrong == 0);
}

TEST_CASE("the gradient points out of the shadow, with bias and chance added where they are asked for",
          "[shadowpyramid]") {
    const std::vector<Asked> beside{{{0, 0, 0}, {1}}, {{1, 0, 0}, {0, 0, 0, 0, 6}}};
    const std::vector<double> light = answers_of_shadowpyramid("", beside);
    CHECK(light[2] > 0.05);
    CHECK(std::abs(light[4]) < 1e-7);
    CHECK(light[5] == 6);
    const std::vector<double> biased = answers_of_shadowpyramid("light_vertical_bias = 0.25\n", beside);
    CHECK(biased[3] - light[3] == Approx(0.25));
    const std::vector<double> chance = answers_of_shadowpyramid("light_randomness = 0.1\n", beside);
    CHECK(chance[2] != light[2]);
    CHECK(std::abs(chance[2] - light[2]) <= 0.1);
    CHECK(chance == answers_of_shadowpyramid("light_randomness = 0.1\n", beside));
}

namespace {

/// The light as cpfg's program keeps it: 11^3 voxels 2 wide, x and z from -10 to 10, y from 0 to 20.
class Table {
public:
    Table() : light_(11 * 11 * 11, 1.0) {}

    void cast(const glm::dvec3& place) {
        const int x = int(std::lround(place.x / 2)) + 5, y = int(place.y / 2), z = int(std::lround(place.z / 2)) + 5;
        for (int layer = 0; layer < 6 && y - layer >= 0; ++layer) {
            for (int i = std::max(x - layer, 0); i <= std::min(x + layer, 10); ++i) {
                for (int k = std::max(z - layer, 0); k <= std::min(z + layer, 10); ++k) {
                    const double away = std::hypot(i - x, layer, k - z);
                    light_[index(i, y - layer, k)] *= 1 - 0.58 * std::pow(6.9, -away);
                }
            }
        }
    }

    double at(const glm::dvec3& place) const {
        const glm::dvec3 where = place / 2.0 + glm::dvec3(5, 0, 5), low = glm::floor(where), part = where - low;
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 up(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::ivec3 at = glm::ivec3(low) + up;
            double share = 1;
            for (int axis = 0; axis < 3; ++axis) share *= up[axis] ? part[axis] : 1 - part[axis];
            const bool inside =
                glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThanEqual(at, glm::ivec3(10)));
            sum += share * (inside ? light_[index(at.x, at.y, at.z)] : 1);
        }
        return sum;
    }

private:
    static std::size_t index(int x, int y, int z) { return std::size_t((x * 11 + y) * 11 + z); }

    std::vector<double> light_;
};

}  // namespace

TEST_CASE("with the numbers of cpfg, y begins at 0 and is cut off, and the gradient is a difference",
          "[shadowpyramid]") {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    Table table;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 place(16 * samples.uniform() - 8, 18 * samples.uniform(), 16 * samples.uniform() - 8);
        questions.push_back({place, {i < 20 ? 1.0 : 0.0, 0, 0, 0}});
        if (i < 20) table.cast(place);
    }
    const std::vector<double> light =
        answers_of_shadowpyramid("grid_size = 11\ngrid_span = 10\nnumbers = \"cpfg\"\n", questions);
    double wrong = 0;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const glm::dvec3& place = questions[i].position;
        wrong = std::max(wrong, std::abs(light[4 * i] - table.at(place)));
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0);
            step[axis] = 1.6;
            const double rise = table.at(place + step) - table.at(place - step);
            wrong = std::max(wrong, std::abs(light[4 * i + 1 + std::size_t(axis)] - rise));
        }
    }
    CHECK(wrong < 1e-5);
    CHECK(answers_of_shadowpyramid("grid_size = 11\ngrid_span = 10\nnumbers = \"cpfg\"\n", {{{0, -9, 0}, {1}}})[0] ==
          1);
}

TEST_CASE("light among pyramids is the same bytes in any order of queries and on any number of threads",
          "[shadowpyramid]") {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < 500; ++i) {
        questions.push_back(
            {{20 * samples.uniform() - 10, 20 * samples.uniform(), 20 * samples.uniform() - 10}, {i % 3 - 1.0}});
    }
    std::vector<double> light = answers_of_shadowpyramid("", questions);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(answers_of_shadowpyramid("", questions) == light);
    }
    std::reverse(questions.begin(), questions.end());
    std::reverse(light.begin(), light.end());
    CHECK(answers_of_shadowpyramid("", questions) == light);
}

TEST_CASE("outside the grid is full light, and casts from there shade nothing", "[shadowpyramid]") {
    const std::string small = "grid_size = 11\ngrid_span = 10\n";
    CHECK(answers_of_shadowpyramid(small, {{{0, 25, 0}, {1}}, {{0, 24, 0}, {0}}, {{1e200, 0, 0}, {1}}}) ==
          std::vector<double>{1, 1, 1});
    CHECK(answers_of_shadowpyramid(small, {{{0, -10, 0}, {1}}})[0] == Approx(0.42));
}

TEST_CASE("more shadow than memory holds ends the run with its reason", "[shadowpyramid]") {
    EnvironmentContext context;
    context.memory = 10000;
    Environment environment = environment_of("[light]\nprocess = \"shadowpyramid\"\nshadow_depth = 60\n", context);
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {1}}});
    CHECK(lacks(message_of([&] { plants.exchange(environment); }), {"1 shadows of 60 layers", "memory"}) == "");
    CHECK(lacks(message_of([] { answers_of_shadowpyramid("grid_size = 1\n", {}); }), {"grid_size"}) == "");
}
