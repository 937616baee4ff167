#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// The first parameter of every answer.
std::vector<double> winners(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"ecosystem\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    const std::vector<double> parameters = plants.parameters();
    std::vector<double> first;
    for (std::size_t at = 0, i = 0; i < questions.size(); at += questions[i++].parameters.size()) {
        first.push_back(parameters[at]);
    }
    return first;
}

std::vector<Asked> stand(int count, double side) {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(side * samples.uniform(), side * samples.uniform(), side * samples.uniform());
        const double radius = std::pow(samples.uniform(), 4);
        questions.push_back({place, {radius, std::floor(5 * samples.uniform())}});
    }
    return questions;
}

bool overlap(const Asked& a, const Asked& b, bool flat) {
    glm::dvec3 apart = a.position - b.position;
    if (flat) apart.y = 0;
    return glm::length(apart) <= a.parameters[0] + b.parameters[0];
}

/// cpfg's rule as it is written.
std::vector<double> scanned(const std::vector<Asked>& all, bool flat) {
    std::vector<double> wins(all.size(), 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < all.size(); ++j) {
            if (i == j || wins[j] == 0 || !overlap(all[i], all[j], flat)) continue;
            const auto &a = all[i].parameters, &b = all[j].parameters;
            if (a[1] < b[1] || (a[1] == b[1] && a[0] <= b[0])) wins[i] = 0;
        }
    }
    return wins;
}

}  // namespace

TEST_CASE("of two discs that overlap the smaller loses, and two of one size both", "[ecosystem]") {
    CHECK(winners("", {{{0, 0, 0}, {1}}, {{3, 0, 0}, {2}}}) == std::vector<double>{0, 1});
    CHECK(winners("", {{{0, 0, 0}, {1}}, {{3.01, 0, 0}, {2}}}) == std::vector<double>{1, 1});
    CHECK(winners("", {{{0, 0, 0}, {1}}, {{0, 9, 2}, {1}}}) == std::vector<double>{0, 0});
    CHECK(winners("3d_case = true", {{{0, 0, 0}, {1}}, {{0, 9, 2}, {1}}}) == std::vector<double>{1, 1});
    CHECK(winners("", {{{0, 0, 0}, {1, 1}}, {{1, 0, 0}, {2, 2}}}) == std::vector<double>{1, 1});
}

TEST_CASE("with vigour the weaker loses, among equals the smaller, whatever their sizes", "[ecosystem]") {
    const std::string vigour = "vigor = true\nscan = ";
    for (const char* scan : {"\"string\"", "\"vigour\""}) {
        CHECK(winners(vigour + scan, {{{0, 0, 0}, {1, 7}}, {{3, 0, 0}, {2, 6}}}) == std::vector<double>{1, 0});
        CHECK(winners(vigour + scan, {{{0, 0, 0}, {1, 7}}, {{3, 0, 0}, {2, 7}}}) == std::vector<double>{0, 1});
    }
}

TEST_CASE("who has lost ends nobody: in string order it depends on who comes first, by vigour it does not",
          "[ecosystem]") {
    // Each overlaps only its neighbours in the row.
    const std::vector<Asked> row{{{0, 0, 0}, {1, 3}}, {{1.5, 0, 0}, {1, 2}}, {{3, 0, 0}, {1, 1}}};
    const std::vector<Asked> back(row.rbegin(), row.rend());
    CHECK(winners("vigor = true", row) == std::vector<double>{1, 0, 1});
    CHECK(winners("vigor = true", back) == std::vector<double>{1, 0, 1});
    CHECK(winners("vigor = true\nscan = \"string\"", row) == std::vector<double>{1, 0, 1});
    CHECK(winners("vigor = true\nscan = \"string\"", back) == std::vector<double>{0, 0, 1});
    const std::vector<Asked> twins{{{0, 0, 0}, {1, 3}}, {{1, 0, 0}, {1, 3}}};
    CHECK(winners("vigor = true", twins) == std::vector<double>{0, 0});
    CHECK(winners("vigor = true\nscan = \"string\"", twins) == std::vector<double>{0, 1});
}

TEST_CASE("the search for overlapping discs finds what comparing every pair finds", "[ecosystem]") {
    for (const bool flat : {true, false}) {
        const std::vector<Asked> questions = stand(400, 6);
        const std::string dimensions = flat ? "" : "3d_case = true\n";
        CHECK(winners(dimensions + "vigor = true\nscan = \"string\"", questions) == scanned(questions, flat));
        const std::vector<double> by_size = winners(dimensions, questions);
        int wrong = 0;
        for (std::size_t i = 0; i < questions.size(); ++i) {
            const auto ends_it = [&](const Asked& other) {
                return &other != &questions[i] && other.parameters[1] == questions[i].parameters[1] &&
                       other.parameters[0] >= questions[i].parameters[0] && overlap(other, questions[i], flat);
            };
            wrong += by_size[i] != std::none_of(questions.begin(), questions.end(), ends_it);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("by vigour no two that stay overlap, every loser overlaps one that beats it, and order changes nothing",
          "[ecosystem]") {
    std::vector<Asked> questions = stand(500, 5);
    for (Asked& asked : questions) asked.parameters[1] += asked.parameters[0] / 7;  // no two alike
    const std::vector<double> wins = winners("vigor = true", questions);
    int overlapping = 0, unbeaten = 0;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        bool beaten = false;
        for (std::size_t j = 0; j < questions.size(); ++j) {
            if (i == j || wins[j] == 0 || !overlap(questions[i], questions[j], true)) continue;
            overlapping += wins[i] == 1;
            beaten |= questions[j].parameters[1] > questions[i].parameters[1];
        }
        unbeaten += wins[i] == 0 && !beaten;
    }
    CHECK(overlapping == 0);
    CHECK(unbeaten == 0);
    std::reverse(questions.begin(), questions.end());
    std::vector<double> reversed = winners("vigor = true", questions);
    std::reverse(reversed.begin(), reversed.end());
    CHECK(reversed == wins);
}

TEST_CASE("a field of many sizes is answered in seconds, the same with any number of threads", "[ecosystem]") {
    const std::vector<Asked> questions = stand(20000, 170);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<double> wins = winners("", questions);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(winners("", questions) == wins);
}

TEST_CASE("a grid without cells is a mistake", "[ecosystem]") {
    CHECK(lacks(message_of([] { winners("grid_size = [0, 1, 1]", {}); }), {"grid_size", "at least 1"}) == "");
}
