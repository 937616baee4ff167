#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::vector<double> ask_density(Environment& environment, const std::vector<Asked>& questions) {
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

std::vector<double> density(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"density\"\n" + lines);
    return ask_density(environment, questions);
}

Environment box() {
    return environment_of(
        "[light]\nprocess = \"density3d\"\nrange = [4, 4, 4]\nposition = [-2, 0, -2]\n"
        "grid_size = [4, 4, 4]\n");
}

}  // namespace

TEST_CASE("density is 1 / (1 + d^2) of all and v / (1 + d) of sources", "[density]") {
    const std::vector<double> answered =
        density("one_point_value = true",
                {{{0, 0, 9}, {0, 0, 0}}, {{2, 0, 0}, {1, 1}}, {{0, -3, 0}, {6}}, {{0, 1, 0}, {1, 2, 3, 4}}});
    CHECK(answered[0] == Approx(1 + 0.2 + 1.5 + 0.5));
    CHECK(std::vector<double>(answered.begin() + 3, answered.end()) == std::vector<double>{1, 1, 6, 1, 2, 3, 4});
}

TEST_CASE("the direction leads to the least crowded side, towards a source that takes away", "[density]") {
    const std::vector<double> away = density("", {{{0, 0, 0}, {0, 0, 0}}, {{0, 2, 0}, {1, 1}}});
    CHECK(away[1] == Approx(-90));
    CHECK(away[2] > 0);
    const std::vector<double> towards = density("", {{{0, 0, 0}, {0, 0, 0}}, {{-2, 0, 0}, {-5}}});
    CHECK(std::abs(towards[1]) == Approx(180));
    const std::vector<double> vector = density("return_vector = true", {{{0, 0, 0}, {0, 0, 0}}, {{3, 4, 0}, {1, 1}}});
    CHECK(vector[1] < 0);
    CHECK(vector[1] / vector[2] == Approx(0.75).epsilon(0.02));
}

TEST_CASE("the least of the unit square is less than at the middle, where the query itself takes room", "[density]") {
    const double corner = density("", {{{0, 0, 0}, {0, 0, 0}}})[0];
    CHECK(corner == Approx(1 / 1.5));
    CHECK(density("one_point_value = true", {{{0, 0, 0}, {0, 0, 0}}})[0] == 1);
}

TEST_CASE("with the numbers of cpfg, the asker adds nothing, and directions are from 0 to 360", "[density]") {
    const std::string as_cpfg = "numbers = \"cpfg\"\n";
    RandomSamples places({5, 2, Stream::process}, 3, 4);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 place(40 * places.uniform() - 20, 40 * places.uniform() - 20, 0);
        CHECK(density(as_cpfg, {{place, {7, 7, 7}}}) == std::vector<double>{0, 90, 0});
    }
    CHECK(density(as_cpfg + "one_point_value = true\n", {{{3, 4, 0}, {7, 7, 7}}}) == std::vector<double>{0, 90, 0});
    CHECK(density(as_cpfg + "return_vector = true\n", {{{3, 4, 0}, {7, 7, 7}}}) == std::vector<double>{0, 90, 0});
    const std::vector<Asked> questions{{{0, 0, 0}, {0, 0, 0}}, {{0.7, 2, 0}, {1, 1}}, {{-1, 1, 0}, {3}}};
    double least = 1e9;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            const double x = -0.5 + 0.2 * i, y = -0.5 + 0.2 * j;
            least = std::min(least,
                             1 / (1 + (x - 0.7) * (x - 0.7) + (y - 2) * (y - 2)) + 3 / (1 + std::hypot(x + 1, y - 1)));
        }
    }
    const std::vector<double> found = density(as_cpfg, questions), ours = density("", questions);
    CHECK(found[0] == Approx(least));
    CHECK(ours[1] < 0);
    CHECK(found[1] > 270);
}

TEST_CASE("with the numbers of cpfg, the slope is a sixth of the fall between the middle ones of the 36 places",
          "[density]") {
    // Measured: two queries 2 apart.
    const double across[] = {180, 0, 270, 90};
    const glm::dvec3 others[] = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}};
    for (int k = 0; k < 4; ++k) {
        const std::vector<double> found =
            density("numbers = \"cpfg\"\n", {{{0, 0, 0}, {0, 0, 0}}, {others[k], {1, 1}}});
        CHECK(found[1] == Approx(across[k]).margin(1e-9));
        CHECK(found[2] == Approx(0.00532).margin(5e-6));
    }
}

TEST_CASE("density is the same bytes in any order of queries and on any number of threads", "[density]") {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < 200; ++i) questions.push_back({{9 * samples.uniform(), 9 * samples.uniform(), 0}, {0, 0, 0}});
    const std::vector<double> first = density("", questions);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(density("", questions) == first);
    }
    std::reverse(questions.begin(), questions.end());
    const std::vector<double> reversed = density("", questions);
    int wrong = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        for (std::size_t k = 0; k < 3; ++k) wrong += first[3 * i + k] != reversed[3 * (199 - i) + k];
    }
    CHECK(wrong == 0);
}

TEST_CASE("density3d adds up in string order, for good, through a checkpoint", "[density3d]") {
    Environment environment = box();
    const std::vector<Asked> questions{
        {{0.1, 0.1, 0.1}, {2}}, {{0.9, 0.9, 0.9}, {3, 8}}, {{-1, 0.5, 0}, {1}}, {{3, 0, 0}, {7}}};
    CHECK(ask_density(environment, questions) == std::vector<double>{2, 5, 8, 1, 0});
    CHECK(environment.statistics(0).back().value == 6);
    std::stringstream saved;
    environment.save(saved);
    Environment resumed = box();
    resumed.restore(saved);
    for (Environment* either : {&environment, &resumed}) {
        CHECK(ask_density(*either, questions) == std::vector<double>{7, 10, 8, 2, 0});
    }
}

TEST_CASE("with the numbers of cpfg, density3d keeps whole sums", "[density3d]") {
    Environment environment = environment_of("[light]\nprocess = \"density3d\"\nnumbers = \"cpfg\"\n");
    const glm::dvec3 place(0.5);
    CHECK(ask_density(environment, {{place, {0.7}}, {place, {2.6}}, {place, {1.5}}, {place, {-0.5}}}) ==
          std::vector<double>{0, 2, 3, 2});
    CHECK(ask_density(environment, {{place, {0.9}}}) == std::vector<double>{2});
}

TEST_CASE("a box of 2^level voxels is as fine as a grid of that size", "[density3d]") {
    const std::vector<Asked> questions{{{0.49, 0, 0}, {1}}, {{0.51, 0, 0}, {1}}, {{0.74, 0, 0}, {1}}};
    for (const char* lines : {"octree_level = 1", "grid_size = [2, 2, 2]"}) {
        Environment environment = environment_of(std::string("[light]\nprocess = \"density3d\"\n") + lines);
        CHECK(ask_density(environment, questions) == std::vector<double>{1, 1, 2});
    }
    CHECK(lacks(message_of([] { environment_of("[light]\nprocess = \"density3d\"\noctree_level = 99"); }),
                {"octree_level"}) == "");
    CHECK(lacks(message_of([] { environment_of("[light]\nprocess = \"density3d\"\nrange = [1, 0, 1]"); }), {"range"}) ==
          "");
}
