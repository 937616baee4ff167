// Herbs: when what opens where. Racemes, cymes, signals.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <map>

using namespace espalier;

namespace {

std::vector<double> ages(const LonePlant& plant, const std::string& symbol) {
    return values_of(plant.string, plant.model->alphabet, symbol);
}

struct Flower {
    std::string branch;  // numbers of the branches that lead to it, from the main axis on
    double age = 0;
};

// Every flower K(t) with its place: "" on the main axis, "2." on its second branch, "2.1." on that one's first.
std::vector<Flower> flowers_of(const LonePlant& plant) {
    const Alphabet& alphabet = plant.model->alphabet;
    const auto offsets = parameter_offsets(plant.string, alphabet);
    std::vector<Flower> flowers;
    std::vector<int> branches = {0};
    std::vector<std::string> path = {""};
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        const std::string& symbol = alphabet.name(plant.string.letters[i]);
        if (symbol == "[") {
            path.push_back(path.back() + std::to_string(++branches.back()) + ".");
            branches.push_back(0);
        } else if (symbol == "]") {
            path.pop_back();
            branches.pop_back();
        } else if (symbol == "K") {
            flowers.push_back({path.back(), plant.string.parameters.data()[offsets[i + 1] - 1]});
        }
    }
    return flowers;
}

// Ages of the flowers at the ends of the main axis's branches, from the lowest branch up.
std::vector<double> ages_on_first_branches(const LonePlant& plant) {
    std::map<int, double> found;
    for (const Flower& flower : flowers_of(plant)) {
        if (std::count(flower.branch.begin(), flower.branch.end(), '.') == 1) {
            found[std::stoi(flower.branch)] = flower.age;
        }
    }
    std::vector<double> result;
    for (auto [branch, age] : found) result.push_back(age);
    return result;
}

}  // namespace

TEST_CASE("crocus: one flower in step TA + 1, leaves at 137.5 degrees that stop growing", "[herbs]") {
    LonePlant crocus("models/herbs/crocus.l", {{"TA", "7"}, {"TL", "9"}, {"TK", "5"}});
    for (int step = 1; step <= 20; ++step) {
        crocus.grow(1);
        CHECK(crocus.counts()["K"] == (step >= 8 ? 1 : 0));
        CHECK(crocus.counts()["L"] == std::min(step, 6));
    }
    for (double age : ages(crocus, "L")) CHECK(age == 9);
    CHECK(ages(crocus, "K") == std::vector<double>{5});
    for (double turn : values_of(crocus.string, crocus.model->alphabet, "/")) CHECK(turn == 137.5);
}

TEST_CASE("shepherds-purse: flowers come one a step from below upwards", "[herbs]") {
    LonePlant plant("models/herbs/shepherds-purse.l", {{"VEGETATIVE", "12"}});
    plant.grow(40);
    const std::vector<double> flowers = ages(plant, "K");
    REQUIRE(flowers.size() == 40 - 13);
    for (std::size_t i = 1; i < flowers.size(); ++i) CHECK(flowers[i] == flowers[i - 1] - 1);
    CHECK(flowers.back() == 0);
    CHECK(plant.counts()["L"] == 12);
    CHECK(plant.counts()["A"] == 1);
}

TEST_CASE("shepherds-purse: flowers of one age look alike wherever they stand", "[herbs]") {
    // The k-th newest flower after 30 steps is as old as the k-th newest after 36, six nodes further up.
    LonePlant early("models/herbs/shepherds-purse.l"), late("models/herbs/shepherds-purse.l");
    early.grow(30);
    late.grow(36);
    const auto a = ages(early, "U"), b = ages(late, "U");
    for (std::size_t k = 1; k <= a.size(); ++k) CHECK(a[a.size() - k] == b[b.size() - k]);
}

TEST_CASE("lily-of-the-valley: an open raceme whose bells are larger below", "[herbs]") {
    LonePlant plant("models/herbs/lily-of-the-valley.l", {{"FLOWERS", "14"}, {"GROWN", "8"}});
    plant.grow(10);
    const std::vector<double> sizes = ages(plant, "K");
    CHECK(sizes.size() == 10);
    CHECK(std::is_sorted(sizes.rbegin(), sizes.rend()));
    CHECK(sizes.front() == 8);
    CHECK(sizes.back() == 1);
    CHECK(symbols_of(plant.string, plant.model->alphabet).back() == "A");
    plant.grow(10);
    CHECK(plant.counts()["K"] == 14);
    CHECK(symbols_of(plant.string, plant.model->alphabet).back() == "A");
}

TEST_CASE("lychnis: e(t) = e(t-8) + e(t-4) flowers in step t", "[herbs]") {
    LonePlant plant("models/herbs/lychnis.l");
    std::vector<int> forks = {0};
    int flowers = 0;
    for (int step = 1; step <= 40; ++step) {
        const auto earlier = [&](int before) {
            return step > before ? forks[static_cast<std::size_t>(step - before)] : 0;
        };
        forks.push_back(step == 1 ? 1 : earlier(8) + earlier(4));
        flowers += forks.back();
        plant.grow(1);
        CHECK(plant.counts()["K"] == flowers);
        CHECK(plant.counts()["A"] == flowers + 1);
    }
    CHECK(flowers > 80);
}

TEST_CASE("mycelis: buds wake from the top down, two steps from node to node, after the top has flowered", "[herbs]") {
    LonePlant plant("models/herbs/mycelis.l", {{"DELAY", "20"}, {"BRANCH_DELAY", "4"}});
    std::vector<int> woken;
    int top_flowers = 0, buds = 0;
    for (int step = 1; step <= 60; ++step) {
        plant.grow(1);
        if (top_flowers == 0 && plant.counts()["K"] > 0) {
            top_flowers = step;
            buds = plant.counts()["["];
        }
        // Branches of the axis only: each begins with its own source of the signal.
        int depth = 0, sources = 0;
        const auto symbols = symbols_of(plant.string, plant.model->alphabet);
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            if (symbols[i] == "[") ++depth;
            if (symbols[i] == "]") --depth;
            if (depth == 1 && symbols[i] == "[" && symbols[i + 2] != "G") ++sources;
        }
        for (int k = static_cast<int>(woken.size()); k < sources; ++k) woken.push_back(step);
    }
    REQUIRE(top_flowers > 20);
    REQUIRE(static_cast<int>(woken.size()) == buds);
    REQUIRE(buds >= 8);
    CHECK(woken.front() > top_flowers);
    for (std::size_t k = 1; k < woken.size(); ++k) CHECK(woken[k] == woken[k - 1] + 2);
}

TEST_CASE("mycelis, by signals and by delays: the higher a branch, the earlier it flowers", "[herbs]") {
    for (const char* file : {"models/herbs/mycelis.l", "models/herbs/mycelis-delays.l"}) {
        LonePlant plant(file);
        plant.grow(130);
        const std::vector<double> branches = ages_on_first_branches(plant);
        REQUIRE(branches.size() >= 8);
        for (std::size_t i = 1; i < branches.size(); ++i) CHECK(branches[i] > branches[i - 1]);
        double top = 0;
        for (const Flower& flower : flowers_of(plant)) {
            if (flower.branch.empty()) top = flower.age;
        }
        CHECK(top > branches.back());
    }
}

TEST_CASE("mycelis: the lower branches, which flower later, become the larger ones", "[herbs]") {
    LonePlant plant("models/herbs/mycelis.l");
    plant.grow(130);
    std::map<std::uint32_t, double> reach;
    for (const Internode& internode : plant.interpretation.geometry.internodes) {
        if (internode.order == 1) reach[internode.axis] += length_of(internode);
    }
    REQUIRE(reach.size() >= 8);
    CHECK(reach.begin()->second > 1.5 * reach.rbegin()->second);
}

TEST_CASE("mycelis-delays: what happens below does not depend on the top", "[herbs]") {
    LonePlant plant("models/herbs/mycelis-delays.l");
    plant.grow(20);
    const std::string whole = plant.text();
    // Cut the top half off and let both grow: the lower half develops alike.
    LonePlant cut("models/herbs/mycelis-delays.l");
    cut.grow(20);
    const auto symbols = symbols_of(cut.string, cut.model->alphabet);
    std::size_t at = 0;
    int depth = 0, nodes = 0;
    for (; at < symbols.size() && nodes < 4; ++at) {
        if (symbols[at] == "[") ++depth;
        if (symbols[at] == "]" && --depth == 0) ++nodes;
    }
    const std::size_t parameters = parameter_offsets(cut.string, cut.model->alphabet)[at];
    cut.string.letters.resize(at);
    cut.string.births.resize(at);
    cut.string.parameters.resize(parameters);
    plant.grow(40);
    cut.grow(40);
    CHECK(plant.text().rfind(cut.text(), 0) == 0);
    CHECK(cut.text().size() > whole.size());
}

TEST_CASE("lilac: every axis ends in a flower, pairs are opposite, and flowers follow the recurrence", "[herbs]") {
    // An axis with n pairs to make: its own flower, and two branches for each pair.
    std::vector<int> f = {1};
    for (int n = 1; n <= 7; ++n) {
        int flowers = 1;
        for (int above = n; above >= 1; --above) flowers += 2 * f[static_cast<std::size_t>(std::max(above - 2, 0))];
        f.push_back(flowers);
    }
    for (int pairs : {3, 5, 7}) {
        LonePlant plant("models/herbs/lilac.l", {{"PAIRS", std::to_string(pairs)}});
        plant.grow(60);
        CHECK(plant.counts()["K"] == f[static_cast<std::size_t>(pairs)]);
        CHECK(plant.counts()["A"] == 0);
        CHECK(plant.counts()["K"] == plant.counts()["["] + 1);
    }
}

TEST_CASE("dibotryoid: n branches with 0 to n - 1 flowers, opening from below on the axis and on branches", "[herbs]") {
    LonePlant plant("models/herbs/dibotryoid.l");
    const int n = 12;
    plant.grow(n);
    CHECK(plant.counts()["K"] == n * (n - 1) / 2);
    std::map<int, std::vector<double>> by_branch;
    for (const Flower& flower : flowers_of(plant)) by_branch[std::stoi(flower.branch)].push_back(flower.age);
    for (auto& [branch, flowers] : by_branch) {
        REQUIRE(static_cast<int>(flowers.size()) == n - branch);
        for (std::size_t i = 0; i < flowers.size(); ++i) {
            CHECK(flowers[i] == n - 1 - branch - static_cast<double>(i));
        }
    }
    CHECK(by_branch.size() == static_cast<std::size_t>(n - 1));
}

TEST_CASE("dichasium: 2^k - 1 flowers, 2^(i-1) of generation i, the lowest oldest", "[herbs]") {
    LonePlant plant("models/herbs/dichasium.l", {{"GENERATIONS", "5"}, {"REST", "3"}});
    plant.grow(30);
    std::map<double, int> by_generation;
    std::map<double, double> age;
    for (const auto& flower : parameters_of(plant.string, plant.model->alphabet, "K")) {
        ++by_generation[flower[0]];
        age[flower[0]] = flower[1];
    }
    CHECK(plant.counts()["K"] == 31);
    for (int g = 1; g <= 5; ++g) {
        CHECK(by_generation[g] == 1 << (g - 1));
        if (g > 1) CHECK(age[g - 1] == age[g] + 3);
    }
}

TEST_CASE("monochasium: one flower a fork; a bostryx turns one way, a cincinnus back and forth", "[herbs]") {
    for (int side : {1, -1}) {
        LonePlant plant("models/herbs/monochasium.l", {{"SIDE", std::to_string(side)}, {"ANGLE", "40"}});
        plant.grow(9);
        CHECK(plant.counts()["K"] == 9);
        std::vector<glm::dvec3> axis;
        for (const Internode& internode : plant.interpretation.geometry.internodes) {
            if (internode.order == 0) axis.push_back(direction_of(internode));
        }
        REQUIRE(axis.size() == 10);
        for (std::size_t i = 1; i < axis.size(); ++i) {
            CHECK(degrees_between(axis[i - 1], axis[i]) == Approx(40));
            const double turn = glm::cross(axis[i - 1], axis[i]).z;
            CHECK((turn > 0) == (side == 1 || i % 2 == 1));
        }
    }
}

TEST_CASE("wild-carrot: RAYS^2 flowers an umbel, stalks turned by the golden angle, steeper in the middle", "[herbs]") {
    LonePlant plant("models/herbs/wild-carrot.l", {{"RAYS", "8"}, {"NODES", "3"}, {"OPEN", "55"}});
    plant.grow(5);
    CHECK(plant.counts()["K"] == 64);
    plant.grow(25);
    CHECK(plant.counts()["K"] == 4 * 64);
    // The first umbel made is the top one: its rays lean out by the root of their number.
    std::vector<glm::dvec3> rays;
    for (const Internode& internode : plant.interpretation.geometry.internodes) {
        if (internode.order == 1 && internode.base_radius < 0.0006) rays.push_back(direction_of(internode));
    }
    REQUIRE(rays.size() == 8);
    for (std::size_t i = 1; i < rays.size(); ++i) {
        CHECK(rays[i].y < rays[i - 1].y);
        CHECK(degrees_between({rays[i - 1].x, 0, rays[i - 1].z}, {rays[i].x, 0, rays[i].z}) == Approx(137.5));
    }
}
