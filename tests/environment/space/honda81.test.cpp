#include "espalier/base/error.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::vector<double> answers_of_honda81(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"honda81\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

std::vector<Asked> random_questions(int count, double side, int vigours) {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(side * samples.uniform(), side * samples.uniform(), side * samples.uniform());
        questions.push_back({place, {std::floor(vigours * samples.uniform()), std::floor(2 * samples.uniform())}});
    }
    return questions;
}

/// The rule as it is written, every pair compared.
double by_definition(const std::vector<Asked>& all, std::size_t i, double radius, bool flat) {
    for (std::size_t j = 0; j < all.size(); ++j) {
        glm::dvec3 apart = all[i].position - all[j].position;
        if (flat) apart.y = 0;
        const bool rivals = i != j && all[i].parameters[1] == all[j].parameters[1];
        if (rivals && all[j].parameters[0] >= all[i].parameters[0] && glm::length(apart) <= radius) return 0;
    }
    return 1;
}

/// A growing tip in the plane; its straight daughter turns to the side that `side` tells.
struct Tip {
    glm::dvec3 place;
    double direction, length, side;

    Tip daughter(bool straight) const {
        const double degree = std::numbers::pi / 180;
        const double turned = direction + side * (straight ? -24.4 : 36.9) * degree;
        const double longer = length * (straight ? 0.94 : 0.87);
        return {place + longer * glm::dvec3(std::cos(turned), 0, std::sin(turned)), turned, longer,
                straight ? -side : side};
    }
};

using Answers = std::function<std::vector<double>(const std::vector<Asked>&)>;

/// Forks of a tier of Terminalia catappa in `steps` steps, with the ratios and angles of Honda, Tomlinson & Fisher
/// (1981); `free` tells of all ends, old ones first, which have room.
int forks(int steps, const Answers& free) {
    std::vector<Tip> tips;
    std::vector<Asked> ends;
    for (int axis = 0; axis < 5; ++axis) {
        const double direction = axis * 138.5 * std::numbers::pi / 180;
        tips.push_back({{std::cos(direction), 0, std::sin(direction)}, direction, 1, axis % 2 == 0 ? 1.0 : -1.0});
    }
    int forked = 0;
    for (int step = 0; step < steps; ++step) {
        forked += static_cast<int>(tips.size());
        for (const Tip& tip : tips) ends.push_back({tip.place, {1, 0}});
        std::vector<Tip> daughters;
        std::vector<Asked> questions = ends;
        for (const Tip& tip : tips) {
            for (const bool straight : {true, false}) {
                daughters.push_back(tip.daughter(straight));
                questions.push_back({daughters.back().place, {straight ? 0.9 : 0.8, 0}});
            }
        }
        const std::vector<double> answered = free(questions);
        tips.clear();
        for (std::size_t i = 0; i < daughters.size(); ++i) {
            if (answered[ends.size() + i] == 1) tips.push_back(daughters[i]);
        }
    }
    return forked;
}

int forks_of_process(int steps, double radius) {
    return forks(steps, [&](const std::vector<Asked>& questions) {
        const std::vector<double> parameters = answers_of_honda81("radius = " + std::to_string(radius), questions);
        std::vector<double> free;
        for (std::size_t i = 0; i < parameters.size(); i += 2) free.push_back(parameters[i]);
        return free;
    });
}

int forks_of_definition(int steps, double radius) {
    return forks(steps, [&](const std::vector<Asked>& questions) {
        std::vector<double> free;
        for (std::size_t i = 0; i < questions.size(); ++i) free.push_back(by_definition(questions, i, radius, true));
        return free;
    });
}

}  // namespace

TEST_CASE("a branch is dominated by one of higher vigour within the radius, not by one beyond it", "[honda81]") {
    const auto pair = [](double apart) {
        return answers_of_honda81("radius = 0.5", {{{0, 0, 0}, {0.9}}, {{apart, 7, 0}, {0.8}}});
    };
    CHECK(pair(0.5) == std::vector<double>{1, 0});
    CHECK(pair(0.501) == std::vector<double>{1, 1});
}

TEST_CASE("two of equal vigour end each other", "[honda81]") {
    CHECK(answers_of_honda81("radius = 1", {{{0, 0, 0}, {3}}, {{0, 0, 1}, {3}}, {{9, 0, 9}, {3}}}) ==
          std::vector<double>{0, 0, 1});
}

TEST_CASE("heights matter in the 3d case only", "[honda81]") {
    const std::vector<Asked> stacked{{{0, 0, 0}, {2}}, {{0, 5, 0}, {1}}};
    CHECK(answers_of_honda81("radius = 1", stacked) == std::vector<double>{1, 0});
    CHECK(answers_of_honda81("radius = 1\n3d_case = true", stacked) == std::vector<double>{1, 1});
}

TEST_CASE("groups do not see each other, and parameters after the first stay", "[honda81]") {
    CHECK(answers_of_honda81("radius = 1", {{{0, 0, 0}, {2, 1, 7}}, {{0, 0, 0}, {1, 2}}, {{0, 0, 0}, {1, 1}}}) ==
          std::vector<double>{1, 1, 7, 1, 2, 0, 1});
}

TEST_CASE("with radius 0 only the very same place counts", "[honda81]") {
    CHECK(answers_of_honda81("", {{{3, 0, 1e9}, {1}}, {{3, 4, 1e9}, {1}}, {{3.0000001, 0, 1e9}, {1}}}) ==
          std::vector<double>{0, 0, 1});
    CHECK(answers_of_honda81("", {{{0, 0, 0}, {1}}, {{0, 0, 0}, {2}}}) == std::vector<double>{0, 1});
}

TEST_CASE("the search for dominating branches finds what comparing every pair finds", "[honda81]") {
    for (const bool flat : {true, false}) {
        for (const double radius : {0.0, 0.02, 0.3, 1.0, 40.0}) {
            const std::vector<Asked> questions = random_questions(300, 4, 40);
            const std::string lines = "radius = " + std::to_string(radius) + "\n3d_case = " + (flat ? "false" : "true");
            const std::vector<double> answered = answers_of_honda81(lines, questions);
            int wrong = 0;
            for (std::size_t i = 0; i < questions.size(); ++i) {
                wrong += answered[2 * i] != by_definition(questions, i, radius, flat);
            }
            CAPTURE(flat, radius);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("at the radius the distance decides as it is rounded", "[honda81]") {
    constexpr double radius = 0.7;
    std::vector<Asked> pairs;
    for (int k = 0; k < 500; ++k) {
        pairs.push_back({{0, 0, 0}, {1, double(k)}});
        pairs.push_back({{radius * std::cos(k), 0, radius * std::sin(k)}, {1, double(k)}});
    }
    const std::vector<double> answered = answers_of_honda81("radius = 0.7", pairs);
    int wrong = 0, near = 0;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
        wrong += answered[2 * i] != by_definition(pairs, i, radius, true);
        near += answered[2 * i] == 0;
    }
    CHECK(wrong == 0);
    CHECK(near > 250);
    CHECK(near < 500);
}

TEST_CASE("the order of the queries and the number of threads change no collision", "[honda81]") {
    std::vector<Asked> questions = random_questions(5000, 20, 30);
    const std::vector<double> first = answers_of_honda81("radius = 0.6\n3d_case = true", questions);
    std::vector<double> alone;
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        alone = answers_of_honda81("radius = 0.6\n3d_case = true", questions);
    }
    CHECK(first == alone);
    std::reverse(questions.begin(), questions.end());
    const std::vector<double> reversed = answers_of_honda81("radius = 0.6\n3d_case = true", questions);
    int wrong = 0;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        wrong += first[2 * i] != reversed[2 * (questions.size() - 1 - i)];
    }
    CHECK(wrong == 0);
}

TEST_CASE("a crowd at one place takes no more than linear time", "[honda81]") {
    std::vector<Asked> crowd;
    for (int i = 0; i < 200000; ++i) crowd.push_back({{1e-3 * (i % 100), 0, 0}, {double(i)}});
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<double> answered = answers_of_honda81("radius = 1", crowd);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));  // pair by pair it is minutes
    CHECK(std::accumulate(answered.begin(), answered.end(), 0.0) == 1);
    CHECK(answered.back() == 1);
}

TEST_CASE("a tier of Terminalia catappa forks everywhere without a radius, less the wider it is", "[honda81]") {
    CHECK(forks_of_process(7, 0) == 5 * (128 - 1));
    int before = forks_of_process(7, 0);
    for (const double radius : {0.1, 0.3, 0.5, 0.7}) {
        const int forked = forks_of_process(7, radius);
        CAPTURE(radius);
        CHECK(forked == forks_of_definition(7, radius));
        CHECK(forked < before);
        before = forked;
    }
}

TEST_CASE("a radius below 0 is a mistake", "[honda81]") {
    CHECK(lacks(message_of([] { answers_of_honda81("radius = -1", {}); }),
                {"scene.toml:3", "'radius'", "at least 0"}) == "");
}
