#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

std::vector<double> answers_of_takenaka(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"takenaka\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

/// The formula with the default constants.
double product(double area, double upkeep, int hits) {
    const double tau = 1 - 0.9 / 2.25;
    return 0.015 * 8.64 * std::pow(tau, 2 * hits) * (area * 2.25 / 4) * (1 - tau * tau) - upkeep;
}

}  // namespace

TEST_CASE("a lone cluster of 100 cm2 produces 0.015 * 8.64 * 56.25 * 0.64", "[takenaka]") {
    const std::vector<double> answered = answers_of_takenaka("", {{{0, 0, 0}, {100, 1.5, 8}}});
    CHECK(answered[0] == 100);
    CHECK(answered[1] == Approx(4.6656 - 1.5));
    CHECK(answered[2] == 8);
}

TEST_CASE("every cluster before the light lets 0.36 of it through", "[takenaka]") {
    std::vector<Asked> stack;
    for (int k = 0; k < 4; ++k) stack.push_back({{0, -20.0 * k, 0}, {100, 1}});
    const std::vector<double> answered = answers_of_takenaka("", stack);
    for (int k = 0; k < 4; ++k) CHECK(answered[2 * static_cast<std::size_t>(k) + 1] == Approx(product(100, 1, k)));
}

TEST_CASE("a cluster's radius is (s/2) sqrt(A / pi), and the beam widens it", "[takenaka]") {
    const double radius = 0.75 * std::sqrt(100 / std::numbers::pi);
    const auto below = [&](double aside, const std::string& lines) {
        return answers_of_takenaka(lines, {{{0, 0, 0}, {100, 0}}, {{aside, 50, 0}, {100, 0}}})[1];
    };
    CHECK(below(0.999 * radius, "") == Approx(product(100, 0, 1)));
    CHECK(below(1.001 * radius, "") == Approx(product(100, 0, 0)));
    CHECK(below(1.4 * radius, "beam_radius = 0.5") == Approx(product(100, 0, 1)));
}

TEST_CASE("sources are places that share the light; what stands beyond or behind does not shade", "[takenaka]") {
    const std::string two = "source = [\"0 100 0 3\", \"100 0 0\"]";
    const std::vector<Asked> roofed{
        {{0, 0, 0}, {100, 0}}, {{0, 50, 0}, {100}}, {{0, 120, 0}, {100}}, {{-9, 0, 0}, {9}}};
    CHECK(answers_of_takenaka(two, roofed)[1] == Approx(0.75 * product(100, 0, 1) + 0.25 * product(100, 0, 0)));
    // A level disc of light around the zenith, half of it hidden by a wide roof to one side.
    const double half =
        answers_of_takenaka("disk_source = [\"10 0 100 0\"]", {{{0, 0, 0}, {1, 0}}, {{500, 99, 0}, {1396263.4}}})[1];
    CHECK(half < product(1, 0, 0));
    CHECK(half > product(1, 0, 1));
}

TEST_CASE("with the numbers of cpfg, a ball around the asking centre shades it, wherever its own centre is",
          "[takenaka]") {
    const double area = 4 * std::numbers::pi * 16 / 9;  // a radius of 2
    for (const double height : {-2.5, -1.0, 1.0, 2.5}) {
        const std::vector<Asked> pair{{{0, 0, 0}, {1, 0}}, {{0, height, 0}, {area}}};
        CHECK(answers_of_takenaka("numbers = \"cpfg\"", pair)[1] == Approx(product(1, 0, height > -2 ? 1 : 0)));
        CHECK(answers_of_takenaka("", pair)[1] == Approx(product(1, 0, height > 0 ? 1 : 0)));
    }
}

TEST_CASE("products are the same bytes in any order of queries and on any number of threads", "[takenaka]") {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < 500; ++i) {
        questions.push_back({{10 * samples.uniform() - 5, 10 * samples.uniform(), 10 * samples.uniform()}, {0.7, 0}});
    }
    const std::string lines = "source = [\"0 100 0 3\", \"60 80 0\", \"-60 80 3\"]";
    const std::vector<double> first = answers_of_takenaka(lines, questions);
    CHECK(*std::min_element(first.begin(), first.end()) < product(0.7, 0, 3));  // they do shade each other
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(answers_of_takenaka(lines, questions) == first);
    }
    std::reverse(questions.begin(), questions.end());
    const std::vector<double> reversed = answers_of_takenaka(lines, questions);
    int wrong = 0;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        wrong += first[2 * i + 1] != reversed[2 * (questions.size() - 1 - i) + 1];
    }
    CHECK(wrong == 0);
}

TEST_CASE("a leaf that spreads less than itself is a mistake", "[takenaka]") {
    CHECK(lacks(message_of([] { answers_of_takenaka("parameter_s = 0.5", {}); }), {"parameter_s", "between 1 and"}) ==
          "");
    CHECK(lacks(message_of([] { answers_of_takenaka("source = [\"0 1 0 -1\"]", {}); }), {"negative"}) == "");
}
