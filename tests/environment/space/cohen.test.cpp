#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::vector<double> answers_of_cohen(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"cohen\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

/// Where the tip at the origin grows, whose heading is +y.
glm::dvec3 direction(const std::string& lines, const std::vector<Asked>& others = {}) {
    std::vector<Asked> questions{{{0, 0, 0}, {0, 0, 0, 0}}};
    questions.insert(questions.end(), others.begin(), others.end());
    const std::vector<double> answered = answers_of_cohen(lines, questions);
    return {answered[1], answered[2], answered[3]};
}

double probability(const std::string& lines, double since_fork, const std::vector<Asked>& others = {}) {
    std::vector<Asked> questions{{{0, 0, 0}, {0, 0, 0, 0, since_fork}}};
    questions.insert(questions.end(), others.begin(), others.end());
    return answers_of_cohen(lines, questions)[4];
}

}  // namespace

TEST_CASE("in the empty field a tip grows straight, and sees nothing of itself", "[cohen]") {
    CHECK(direction("") == glm::dvec3(0, 1, 0));
    CHECK(answers_of_cohen("", {{{0, 0, 0}, {7, 0, 0, 0}}})[0] == 0);
    CHECK(direction("", {{{0, -0.1, 0}, {1}}}) == glm::dvec3(0, 1, 0));  // its own axis behind it
}

TEST_CASE("the density of a neighbour and of a source fall with the distance as they are defined", "[cohen]") {
    CHECK(answers_of_cohen("reach = 2", {{{0, 0, 0}, {0, 0, 0, 0}}, {{4, 0, 0}, {3}}})[0] == Approx(3.0 / 5));
    CHECK(answers_of_cohen("reach = 2\ninhibitors = [[0, 0, 4]]\ninhibition = 6", {{{0, 0, 0}, {0, 0, 0, 0}}})[0] ==
          Approx(2));
    CHECK(answers_of_cohen("reach = 2\nattractors = [[0, 0, 4]]\nattraction = 6", {{{0, 0, 0}, {0, 0, 0, 0}}})[0] ==
          Approx(-2));
}

TEST_CASE("the direction follows the gradient of the density it answers", "[cohen]") {
    const std::string lines = "reach = 0.3\nresistance = 0\nattractors = [[1, 2, 0]]\ninhibitors = [[-1, 0.5, 1]]\n";
    const auto density = [&](const glm::dvec3& place) {
        return answers_of_cohen(lines, {{place, {0, 0, 0, 0}}, {{0.2, -0.1, 0.3}, {2}}})[0];
    };
    const double h = 1e-5;
    const glm::dvec3 fall((density({-h, 0, 0}) - density({h, 0, 0})), (density({0, -h, 0}) - density({0, h, 0})),
                          (density({0, 0, -h}) - density({0, 0, h})));
    CHECK(glm::distance(direction(lines, {{{0.2, -0.1, 0.3}, {2}}}), glm::normalize(fall)) < 1e-6);
}

TEST_CASE("attractors bend a tip towards themselves, inhibitors and neighbours away, less the more it resists",
          "[cohen]") {
    CHECK(direction("attractors = [[1, 0, 0]]").x > 0);
    CHECK(direction("inhibitors = [[1, 0, 0]]").x < 0);
    CHECK(direction("", {{{0.1, 0, 0}, {1}}}).x < 0);
    double before = 1;
    for (const char* resistance : {"0", "0.5", "1", "2", "4"}) {
        const double x = direction(std::string("attractors = [[1, 0, 0]]\nresistance = ") + resistance).x;
        CHECK(x <= before);
        CHECK(x > 0);
        before = x;
    }
    CHECK(before < 0.1);
    CHECK(direction("resistance = 1\ntropism = [1, 0, 0]").x == Approx(std::numbers::sqrt2 / 2));
}

TEST_CASE("forks are rarer the denser the place, over five densities", "[cohen]") {
    CHECK(probability("branching = 0.4", 0) == Approx(0.4));
    double before = 1;
    for (const double weight : {0.0, 1.0, 2.0, 4.0, 8.0}) {
        const double now = probability("branching = 0.4\ncrowding = 3", 0, {{{0, -0.1, 0}, {weight}}});
        CHECK(now == Approx(0.4 * std::exp(-weight / 2 / 3)));
        CHECK(now < before);
        before = now;
    }
}

TEST_CASE("there is no fork before the least distance, and then its probability rises", "[cohen]") {
    const std::string lines = "branching = 0.4\nfork_distance = 0.5\nfork_rise = 0.2";
    CHECK(probability(lines, 0.499) == 0);
    CHECK(probability(lines, 0.6) == Approx(0.2));
    CHECK(probability(lines, 0.7) == Approx(0.4));
    CHECK(probability(lines, 9) == Approx(0.4));
}

TEST_CASE("the order of the queries changes no direction", "[cohen]") {
    std::vector<Asked> questions;
    for (int i = 0; i < 300; ++i) {
        questions.push_back({{std::sin(i), std::cos(1.3 * i), std::sin(2.1 * i)}, {0, 0, 0, 0, 1}});
    }
    const std::vector<double> first = answers_of_cohen("", questions);
    std::reverse(questions.begin(), questions.end());
    const std::vector<double> reversed = answers_of_cohen("", questions);
    int wrong = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        wrong += first[i] != reversed[5 * (questions.size() - 1 - i / 5) + i % 5];
    }
    CHECK(wrong == 0);
}

TEST_CASE("a reach that is not positive and a probability above 1 are mistakes", "[cohen]") {
    CHECK(lacks(message_of([] { answers_of_cohen("reach = 0", {}); }), {"scene.toml:3", "'reach'"}) == "");
    CHECK(lacks(message_of([] { answers_of_cohen("branching = 2", {}); }), {"'branching'", "1"}) == "");
}
