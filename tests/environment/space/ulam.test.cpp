#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "environment/space/ulam_automaton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace espalier;
using namespace espalier::environment;

namespace {

using Site = std::array<int, 3>;
using Sites = std::set<Site>;

/// Lattice steps to the edge neighbours, in lattice coordinates, and where a cell of the lattice stands.
struct Lattice {
    std::vector<Site> steps;
    std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};

    glm::dvec3 place(const Site& cell) const {
        return double(cell[0]) * axes[0] + double(cell[1]) * axes[1] + double(cell[2]) * axes[2];
    }
};

const Lattice square{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
const Lattice cubic{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
const Lattice hexagonal{{{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, -1, 0}},
                        {glm::dvec3(1, 0, 0), glm::dvec3(0.5, std::sqrt(0.75), 0), glm::dvec3(0, 0, 1)}};

/// Living cells after each step; the cells born last wish for all their neighbours, or all living cells do.
std::vector<std::size_t> pattern(const Lattice& lattice, const std::string& rule, int steps, bool all_wish = false,
                                 Sites* end = nullptr) {
    Environment environment = environment_of("[light]\nprocess = \"ulam\"\nrule = \"" + rule + "\"\n");
    Sites living{{0, 0, 0}}, born = living;
    std::vector<std::size_t> counts{1};
    for (int step = 0; step < steps; ++step) {
        std::vector<Asked> questions;
        for (const Site& cell : living) questions.push_back({lattice.place(cell), {1}});
        std::vector<Site> wishes;
        for (const Site& cell : all_wish ? living : born) {
            for (const Site& by : lattice.steps) {
                const Site wish{cell[0] + by[0], cell[1] + by[1], cell[2] + by[2]};
                if (living.count(wish)) continue;
                wishes.push_back(wish);
                questions.push_back({lattice.place(wish) + 1e-9 * double(questions.size() % 7), {0}});
            }
        }
        AskingPlants plants;
        plants.add(questions).exchange(environment);
        const std::vector<double> answers = plants.parameters();
        born.clear();
        for (std::size_t i = 0; i < wishes.size(); ++i) {
            if (answers[questions.size() - wishes.size() + i] == 1) born.insert(wishes[i]);
        }
        living.insert(born.begin(), born.end());
        counts.push_back(living.size());
    }
    if (end) *end = living;
    return counts;
}

}  // namespace

TEST_CASE("the simple pattern has 4 * 3^(ones(n - 1) - 1) births in step n", "[ulam]") {
    CHECK(pattern(square, "simple", 15) ==
          std::vector<std::size_t>{1, 5, 9, 21, 25, 37, 49, 85, 89, 101, 113, 149, 161, 197, 233, 341});
    CHECK(pattern(square, "simple", 11, true) == pattern(square, "simple", 11));
}

TEST_CASE("cells that touch refuse each other: 65 steps of the four readings of Ulam's second rule", "[ulam]") {
    const auto published = [](const UlamRule& rule) {
        std::vector<std::size_t> counts;
        for (const int cells : UlamAutomaton(rule).cells(65)) counts.push_back(static_cast<std::size_t>(cells));
        return counts;
    };
    const auto births = published({"births"}), eligible = published({"eligible"});
    const auto wishes = published({"wishes"}), persistent = published({"wishes", true});
    const auto last = [](const std::vector<std::size_t>& counts) {
        return std::vector<std::size_t>(counts.begin() + 13, counts.begin() + 17);
    };
    CHECK(last(births) == std::vector<std::size_t>{157, 169, 181, 201});      // A170896
    CHECK(last(eligible) == std::vector<std::size_t>{149, 161, 173, 193});    // A267190
    CHECK(last(persistent) == std::vector<std::size_t>{149, 161, 173, 185});  // A151895
    CHECK(eligible[46] == 1753);
    CHECK(eligible[47] == 1829);
    CHECK(wishes[46] == 1753);
    CHECK(wishes[47] == 1821);
    CHECK(pattern(square, "births", 65) == births);
    CHECK(pattern(square, "eligible", 65) == eligible);
    CHECK(pattern(square, "wishes", 65) == wishes);
    CHECK(pattern(square, "wishes", 65, true) == persistent);
}

TEST_CASE("in space the pattern keeps the 48 symmetries of the cube, in the hexagonal plane the six turns", "[ulam]") {
    Sites cells;
    CHECK(pattern(cubic, "simple", 4, false, &cells) == std::vector<std::size_t>{1, 7, 13, 43, 49});
    Sites turned, mirrored;
    for (const Site& cell : cells) turned.insert({cell[1], cell[2], cell[0]});
    for (const Site& cell : cells) mirrored.insert({-cell[1], cell[0], cell[2]});
    CHECK(turned == cells);
    CHECK(mirrored == cells);

    CHECK(pattern(hexagonal, "simple", 4, false, &cells).back() > 13);
    turned.clear();
    for (const Site& cell : cells) turned.insert({-cell[1], cell[0] + cell[1], 0});
    CHECK(turned == cells);
}

TEST_CASE("a query may learn how many cells live at its edges and corners", "[ulam]") {
    Environment environment = environment_of("[light]\nprocess = \"ulam\"\n");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {2}}, {{1, 1, 0}, {1}}, {{1, 0, 0}, {0, 0, 0}}, {{2, 0, 0}, {-1, 9, 9, 9}}})
        .exchange(environment);
    CHECK(plants.parameters() == std::vector<double>{2, 1, 0, 2, 0, 0, 0, 1, 9});
}

TEST_CASE("a crowd at one place is one cell, and answers do not depend on the order of the queries", "[ulam]") {
    Environment environment = environment_of("[light]\nprocess = \"ulam\"\n");
    std::vector<Asked> questions{{{0, 0, 0}, {1}}};
    for (int i = 0; i < 20000; ++i) questions.push_back({{1, 0, 0}, {0}});
    AskingPlants forward, backward;
    forward.add(questions).exchange(environment);
    const std::vector<double> answers = forward.parameters();
    CHECK(std::count(answers.begin(), answers.end(), 1) == 20001);
    std::reverse(questions.begin(), questions.end());
    backward.add(questions).exchange(environment);
    CHECK(backward.parameters() == answers);
}

TEST_CASE("a pattern's parameters are checked", "[ulam]") {
    const auto refused = [](const std::string& lines) {
        return message_of([&] { environment_of("[light]\nprocess = \"ulam\"\n" + lines); });
    };
    CHECK(lacks(refused("edge = 0"), {"'edge'", "greater than 0"}) == "");
    CHECK(lacks(refused("corner = 100"), {"'corner'"}) == "");
    CHECK(lacks(refused("rule = \"birth\""), {"did you mean 'births'"}) == "");
}
