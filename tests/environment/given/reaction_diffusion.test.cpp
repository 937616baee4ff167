#include "espalier/environment/environment_process.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"
#include "catch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

using namespace espalier;

namespace {

/// A process on its own, asked without plants.
struct Alone {
    Fields fields;
    std::unique_ptr<EnvironmentProcess> process;

    explicit Alone(const std::string& text, std::uint64_t seed = 1) {
        Settings settings = Settings::parse_toml(text, "test.toml");
        EnvironmentContext context;
        context.name = "pattern";
        context.seed = seed;
        process = registered<ProcessType>().at("reaction-diffusion")->make(settings, context, fields);
    }

    void run(int steps) {
        for (int i = 0; i < steps; ++i) {
            WorldView world;
            world.step = ++step_;
            process->advance(world, {}, fields);
        }
    }

    std::vector<double> ask(const glm::dvec3& place, std::vector<double> parameters) {
        Query query;
        query.pose.position = place;
        const std::vector<double> asked = parameters;
        query.parameters = asked;
        std::vector<Answer> answers = {Answer(parameters.data(), parameters.size())};
        process->answer({}, std::span(&query, 1), answers, fields);
        return parameters;
    }

    double count() const { return process->statistics(0).front().value; }

private:
    int step_ = 0;
};

struct Leaf {
    double azimuth, height;
};

/// All organs of a stem that has grown until there are `count` (or for 240 steps).
std::vector<Leaf> leaves_of(const std::string& text, std::uint64_t seed, int count) {
    Alone stem(text, seed);
    for (int step = 0; step < 240 && stem.count() < count; ++step) stem.run(1);
    std::vector<Leaf> leaves;
    for (int k = 1; k <= stem.count() && k <= count; ++k) {
        const std::vector<double> answer = stem.ask({}, {double(k), 0, 0});
        REQUIRE(answer[0] == k);
        leaves.push_back({answer[1], answer[2]});
    }
    return leaves;
}

/// From leaf to leaf behind the first `skipped`, turned so that most are less than 180 degrees.
std::vector<double> divergences(const std::vector<Leaf>& leaves, std::size_t skipped) {
    std::vector<double> turns;
    std::size_t small = 0;
    for (std::size_t i = skipped + 1; i < leaves.size(); ++i) {
        turns.push_back(std::fmod(leaves[i].azimuth - leaves[i - 1].azimuth + 720, 360));
        small += turns.back() < 180;
    }
    if (2 * small < turns.size()) {
        for (double& turn : turns) turn = 360 - turn;
    }
    return turns;
}

struct Order {
    std::size_t all = 0, broken = 0;
    double sum = 0;  ///< sum over those in order
};

/// In 20 runs, behind the first 12 of 40 leaves: a divergence more than 30 degrees from 137.5 breaks the order.
Order order_of(const std::string& text, std::uint64_t first_seed = 1) {
    std::vector<std::vector<Leaf>> runs(20);
    for_in_parallel(std::size_t{0}, runs.size(), [&](std::size_t i) { runs[i] = leaves_of(text, first_seed + i, 40); });
    Order order;
    for (const auto& leaves : runs) {
        for (double turn : divergences(leaves, 12)) {
            const bool breaks = std::abs(turn - 137.5) > 30;
            ++order.all;
            order.broken += breaks;
            order.sum += breaks ? 0 : turn;
        }
    }
    return order;
}

// Pieces, and meshes they close, of the cells that are veins; cells that share an edge or a corner are one piece.
std::pair<int, int> pieces_and_meshes(const std::set<std::pair<int, int>>& veins) {
    std::set<std::pair<int, int>> corners, left = veins;
    std::set<std::array<int, 3>> edges;
    for (auto [x, y] : veins) {
        for (int i = 0; i < 4; ++i) corners.insert({x + i % 2, y + i / 2});
        edges.insert({{x, y, 0}});
        edges.insert({{x, y + 1, 0}});
        edges.insert({{x, y, 1}});
        edges.insert({{x + 1, y, 1}});
    }
    int pieces = 0;
    while (!left.empty()) {
        ++pieces;
        std::vector<std::pair<int, int>> reached = {*left.begin()};
        left.erase(left.begin());
        while (!reached.empty()) {
            const auto [x, y] = reached.back();
            reached.pop_back();
            for (int i = 0; i < 9; ++i) {
                const std::pair<int, int> next(x + i % 3 - 1, y + i / 3 - 1);
                if (left.erase(next)) reached.push_back(next);
            }
        }
    }
    const int euler = int(corners.size()) - int(edges.size()) + int(veins.size());
    return {pieces, pieces - euler};
}

std::set<std::pair<int, int>> veins_of(Alone& sheet) {
    std::set<std::pair<int, int>> veins;
    for (int x = 0; x < 56; ++x) {
        for (int y = 0; y < 40; ++y) {
            if (sheet.ask({x + 0.5, y + 0.5, 0}, {0})[0] > 0.5) veins.insert({x, y});
        }
    }
    return veins;
}

}  // namespace

TEST_CASE("reaction-diffusion: leaves arise one above the other in a spiral of 137.5 +- 8 degrees", "[reaction]") {
    const Order order = order_of("noise = 0.01");
    INFO(order.broken << " of " << order.all << " are out of order");
    CHECK(order.all > 500);
    CHECK(static_cast<double>(order.broken) < 0.12 * static_cast<double>(order.all));
    CHECK(order.sum / static_cast<double>(order.all - order.broken) == Approx(137.5).margin(8));
}

TEST_CASE("reaction-diffusion: a weak second inhibitor leaves the order as it is, a strong one breaks it more often",
          "[reaction]") {
    const auto broken = [](const char* strength) {
        Order sum;
        for (const std::uint64_t first_seed : {1u, 101u, 201u}) {
            const Order order = order_of(std::string("noise = 0.05\nsecond_inhibitor = ") + strength, first_seed);
            sum.broken += order.broken;
            sum.all += order.all;
        }
        UNSCOPED_INFO(sum.broken << " of " << sum.all << " with a strength of " << strength);
        return static_cast<double>(sum.broken) / static_cast<double>(sum.all);
    };
    const double none = broken("0"), weak = broken("0.02"), strong = broken("0.1");
    CHECK(none == Approx(0.24).margin(0.08));
    CHECK(std::abs(weak - none) < 0.08);
    CHECK(strong > none + 0.08);
}

TEST_CASE(
    "reaction-diffusion: two antagonists that spread make the spiral, which noise disturbs; one that stays disturbs "
    "more",
    "[reaction]") {
    const auto order = [](const char* noise, const char* spread) {
        return order_of(fmt::format("noise = {}\nsecond_inhibitor = 0.1\nsecond_spread = {}", noise, spread), 5001);
    };
    const auto broken = [](const Order& of) { return static_cast<double>(of.broken) / static_cast<double>(of.all); };
    const Order calm = order("0.01", "0.05"), disturbed = order("0.05", "0.05"), staying = order("0.05", "0");
    INFO(broken(calm) << ", " << broken(disturbed) << ", " << broken(staying));
    CHECK(broken(calm) < 0.14);
    CHECK(calm.sum / static_cast<double>(calm.all - calm.broken) == Approx(137.5).margin(8));
    CHECK(broken(disturbed) > broken(calm) + 0.05);
    CHECK(broken(staying) > broken(disturbed) + 0.05);
}

TEST_CASE("reaction-diffusion: a second antagonist without strength changes no leaf, however far it spreads",
          "[reaction]") {
    const auto none = leaves_of("", 9, 12), spread = leaves_of("second_spread = 0.1", 9, 12);
    REQUIRE(none.size() == spread.size());
    for (std::size_t i = 0; i < none.size(); ++i) {
        CHECK(none[i].azimuth == spread[i].azimuth);
        CHECK(none[i].height == spread[i].height);
    }
}

TEST_CASE("reaction-diffusion: the same seed gives the same leaves, another seed others", "[reaction]") {
    const std::vector<Leaf> one = leaves_of("", 7, 12), again = leaves_of("", 7, 12), other = leaves_of("", 8, 12);
    bool differs = false;
    for (std::size_t i = 0; i < 12; ++i) {
        CHECK(one[i].azimuth == again[i].azimuth);
        CHECK(one[i].height == again[i].height);
        differs = differs || one[i].azimuth != other[i].azimuth;
    }
    CHECK(differs);
}

TEST_CASE("reaction-diffusion: a restored checkpoint goes on as if nothing had happened", "[reaction]") {
    for (const char* text : {"", "second_inhibitor = 0.1\nsecond_spread = 0.05", "pattern = \"net\""}) {
        Alone whole(text), first(text), rest(text);
        whole.run(30);
        first.run(18);
        std::stringstream checkpoint;
        first.process->save(checkpoint);
        rest.process->restore(checkpoint);
        rest.run(12);
        CHECK(rest.count() == whole.count());
        const auto values = [](const Alone& alone) { return alone.fields.need("pattern").current()->grid; };
        const auto expected = values(whole), found = values(rest);
        for (auto at = expected->cbeginValueOn(); at; ++at) CHECK(found->tree().getValue(at.getCoord()) == *at);
    }
}

TEST_CASE("reaction-diffusion: veins only spread, and become one net with closed meshes; with half the uptake a tree",
          "[reaction]") {
    Alone sheet("pattern = \"net\"");
    std::set<std::pair<int, int>> before;
    for (int part = 0; part < 6; ++part) {
        sheet.run(10);
        const auto veins = veins_of(sheet);
        CHECK(std::includes(veins.begin(), veins.end(), before.begin(), before.end()));
        before = veins;
    }
    const auto [pieces, meshes] = pieces_and_meshes(before);
    CHECK(before.size() == sheet.count());
    CHECK(pieces == 1);
    CHECK(meshes >= 5);
    CHECK(sheet.ask({-1, 3, 0}, {5})[0] == 0);

    Alone frugal("pattern = \"net\"\nuptake = 0.1");
    frugal.run(60);
    const auto [trees, loops] = pieces_and_meshes(veins_of(frugal));
    CHECK(trees == 1);
    CHECK(loops == 0);
}

TEST_CASE("reaction-diffusion: settings out of range are refused by name", "[reaction]") {
    CHECK_THROWS_WITH(Alone("columns = 3"), Catch::Contains("columns"));
    CHECK_THROWS_WITH(Alone("pattern = \"nets\""), Catch::Contains("net"));
    CHECK_THROWS_WITH(Alone("noise = 2"), Catch::Contains("noise"));
}
