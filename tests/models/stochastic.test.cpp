// models/stochastic: frequencies and moments against what the weights and distributions say.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

using namespace espalier;

namespace {

LonePlant stochastic(const std::string& file, int steps, Defines defines = {}, std::uint64_t seed = 1) {
    LonePlant plant("models/stochastic/" + file + ".l", std::move(defines), seed);
    plant.grow(steps);
    return plant;
}

double chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        sum += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    }
    return sum;
}

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments(const std::vector<double>& values) {
    Moments result;
    for (double value : values) result.mean += value / static_cast<double>(values.size());
    for (double value : values) {
        result.variance += (value - result.mean) * (value - result.mean) / static_cast<double>(values.size() - 1);
    }
    return result;
}

}  // namespace

TEST_CASE("Branching by chance: 10^5 draws agree with the weights", "[stochastic]") {
    LonePlant plant("models/stochastic/branching.l", {}, 3);
    while (plant.counts()["F"] < 100'000) plant.grow(1);
    auto before = plant.counts();
    plant.grow(1);
    auto after = plant.counts();
    // The productions add both turns, a left turn, a right turn.
    const double draws = before["F"], left = after["+"] - before["+"], right = after["-"] - before["-"];
    const double both = left + right - draws;
    CHECK(after["F"] == before["F"] * 3 + 2 * both);
    CHECK(chi_square({both, left - both, right - both}, {0.33 * draws, 0.33 * draws, 0.34 * draws}) < 9.21);
}

TEST_CASE("Branching by chance: growth by 3.66 a step; only the proportions of weights count", "[stochastic]") {
    double segments = 0;
    const int plants = 500;
    for (int seed = 0; seed < plants; ++seed) {
        segments += stochastic("branching", 4, {}, static_cast<std::uint64_t>(seed)).counts()["F"];
    }
    CHECK(segments / plants == Approx(std::pow(3.66, 4)).epsilon(0.04));
    CHECK(stochastic("branching", 5).text() == stochastic("branching", 5, {{"SUM", "128"}}).text());
}

TEST_CASE("Flower field: 3^n plants each, all different, and the parts of the segments that the weights say",
          "[stochastic]") {
    LonePlant field("models/stochastic/flower-field.l", {{"PLANTS", "60"}}, 1);
    field.grow(4);
    CHECK(field.counts()["Plant"] == 60 * 27);
    auto before = field.counts();
    field.grow(1);
    auto after = field.counts();
    // A segment becomes two with two leaves between them, or two, or stays alone.
    const double leafy = (after["Leaf"] - 2 * before["Plant"] - 2 * before["Internode"]) / 2.0;
    const double doubled = after["Segment"] - 2 * before["Internode"] - before["Segment"] - leafy;
    const double segments = before["Segment"], still = segments - leafy - doubled;
    CHECK(chi_square({leafy, doubled, still}, {0.33 * segments, 0.33 * segments, 0.34 * segments}) < 9.21);

    const LonePlant small = stochastic("flower-field", 5);
    std::set<std::string> individuals;
    const std::string text = small.text();
    for (std::size_t at = text.find("@M"); at != std::string::npos;) {
        const std::size_t next = text.find("@M", at + 1);
        const std::size_t behind = text.find('P', at);
        individuals.insert(text.substr(behind, next == std::string::npos ? next : next - behind));
        at = next;
    }
    CHECK(individuals.size() == 12);
}

TEST_CASE("Random tree: lengths, angles and leaves have the moments asked for", "[stochastic]") {
    const LonePlant tree = stochastic("random-tree", 12);
    std::vector<double> lengths, angles, leaves;
    for (const auto& p : parameters_of(tree.string, tree.model->alphabet, "F"))
        lengths.push_back(p[1] / std::pow(0.85, p[0]));
    for (const char* turn : {"+", "-"}) {
        for (const auto& p : parameters_of(tree.string, tree.model->alphabet, turn)) angles.push_back(p[0]);
    }
    for (const auto& p : parameters_of(tree.string, tree.model->alphabet, "L")) leaves.push_back(p[0]);
    REQUIRE(lengths.size() == 4095);
    CHECK(moments(lengths).mean == Approx(1).margin(4 * 0.15 / 64));
    CHECK(std::sqrt(moments(lengths).variance) == Approx(0.15).epsilon(0.05));
    CHECK(moments(angles).mean == Approx(35).margin(4 * 8 / 90.0));
    CHECK(std::sqrt(moments(angles).variance) == Approx(8).epsilon(0.05));
    CHECK(moments(leaves).mean == Approx(4 * 0.4).margin(4 * 0.98 / 64));
    CHECK(moments(leaves).variance == Approx(4 * 0.4 * 0.6).epsilon(0.08));
    double drawn = 0;
    for (double n : leaves) drawn += n;
    CHECK(tree.interpretation.geometry.polygons.size() == static_cast<std::size_t>(drawn));
    CHECK(stochastic("random-tree", 8).text() == stochastic("random-tree", 8).text());
    CHECK(stochastic("random-tree", 8).text() != stochastic("random-tree", 8, {}, 2).text());
}

TEST_CASE("Galton's board: the ends are binomial", "[stochastic]") {
    const LonePlant board = stochastic("galton", 14, {{"BALLS", "4000"}});
    std::vector<double> ends(13, 0), expected(13, 0);
    std::set<std::vector<double>> places;
    for (const auto& ball : parameters_of(board.string, board.model->alphabet, "Resting")) {
        places.insert(ball);
        ++ends[static_cast<std::size_t>(std::lround(ball[0] + 6))];
    }
    CHECK(places.size() == 4000);
    double choose = 1;
    for (int k = 0; k <= 12; ++k) {
        expected[static_cast<std::size_t>(k)] = 4000 * choose / 4096;
        choose = choose * (12 - k) / (k + 1);
    }
    // The rare ends together, so that every class holds at least five.
    const auto classes = [](const std::vector<double>& all) {
        std::vector<double> result(all.begin() + 1, all.end() - 1);
        result.front() += all.front();
        result.back() += all.back();
        return result;
    };
    CHECK(chi_square(classes(ends), classes(expected)) < 23.2);  // 10 degrees of freedom, p = 0.01
}

TEST_CASE("Distributions: uniform, normal, beta and binomial numbers have their means and variances", "[stochastic]") {
    const LonePlant row = stochastic("distributions", 1, {{"NUMBER", "20000"}});
    const auto draws = parameters_of(row.string, row.model->alphabet, "S");
    REQUIRE(draws.size() == 20'000);
    const std::array<Moments, 4> expected{Moments{1, 4 / 12.0}, Moments{1, 0.25}, Moments{2 / 7.0, 10 / (49.0 * 8)},
                                          Moments{3, 2.1}};
    for (std::size_t i = 0; i < 4; ++i) {
        INFO(i);
        std::vector<double> column;
        for (const auto& draw : draws) column.push_back(draw[i]);
        const Moments found = moments(column);
        CHECK(found.mean == Approx(expected[i].mean).margin(4 * std::sqrt(expected[i].variance / 20'000)));
        CHECK(found.variance == Approx(expected[i].variance).epsilon(0.05));
    }
}

TEST_CASE("Weights: a bud opens with the probability its parameter says", "[stochastic]") {
    const LonePlant rows = stochastic("weights", 2, {{"BUDS", "2000"}});
    std::array<double, 5> open{};
    for (const auto& flower : parameters_of(rows.string, rows.model->alphabet, "O"))
        ++open[static_cast<std::size_t>(std::lround(4 * flower[0]))];
    CHECK(open[0] == 0);
    CHECK(open[4] == 2000);
    for (std::size_t quarter : {1u, 2u, 3u}) {
        const double p = static_cast<double>(quarter) / 4;
        CHECK(open[quarter] / 2000 == Approx(p).margin(3 * std::sqrt(p * (1 - p) / 2000)));
    }
    CHECK(parameters_of(rows.string, rows.model->alphabet, "O").size() +
              parameters_of(rows.string, rows.model->alphabet, "X").size() ==
          10'000);
}
