// Carbon against closed forms, a slow solver of its own, and its balance.
#include "catch.h"
#include "environment/leaf/carbon/sugar_transport.h"
#include "environment/light/lit_leaves.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;
using namespace espalier::environment::carbon;
using Catch::Contains;

namespace {

Environment carbon_process(const std::string& lines, std::uint32_t plants = 1) {
    EnvironmentContext context;
    context.plants = plants;
    return environment_of("[carbon]\nprocess = \"carbon\"\n" + lines, context);
}

Asked wish(double grams, std::vector<double> more = {}) {
    more.insert(more.begin(), grams);
    return {{}, more, "carbon"};
}

AskingPlants plant_with(const std::vector<Asked>& wishes) {
    AskingPlants plants({"carbon"});
    plants.add(wishes);
    return plants;
}

double of(const Environment& environment, const std::string& name, std::uint32_t plant = 0) {
    for (const Quantity& quantity : environment.statistics(plant)) {
        if (quantity.name == name) return quantity.value;
    }
    throw std::runtime_error("no statistic " + name);
}

/// Any tree of nodes with sources and sinks.
std::vector<SugarNode> any_tree(std::mt19937& random, std::size_t size) {
    std::uniform_real_distribution<> unit(0, 1);
    std::vector<SugarNode> nodes(size);
    for (std::size_t i = 0; i < size; ++i) {
        SugarNode& node = nodes[i];
        if (i > 0) node.bearer = static_cast<std::uint32_t>(unit(random) * static_cast<double>(i));
        node.conductance = std::pow(10, 4 * unit(random) - 2);
        node.volume = std::pow(10, 3 * unit(random) - 2);
        node.sugar = unit(random) < 0.5 ? 0 : 0.1 * unit(random) * node.volume;
        node.source = unit(random) < 0.4 ? 3 * unit(random) : 0;
        node.sink = unit(random) < 0.5 ? 4 * unit(random) : 0;
        node.upkeep = 0.1 * unit(random);
    }
    return nodes;
}

/// What comes to each node and does not stay, of the largest term.
double imbalance(const std::vector<SugarNode>& nodes, const std::vector<double>& c, double days,
                 const HalfSaturation& half) {
    std::vector<double> left(nodes.size());
    double largest = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const SugarNode& node = nodes[i];
        const double taken = node.sink * c[i] / (half.sink + c[i]) + node.upkeep * c[i] / (half.upkeep + c[i]);
        left[i] += (node.sugar - node.volume * c[i]) / days + node.source - taken;
        largest = std::max({largest, node.source, taken, node.volume * c[i] / days});
        if (node.bearer == SugarNode::no_bearer) continue;
        const double flow = node.conductance * (c[node.bearer] - c[i]);
        left[i] += flow;
        left[node.bearer] -= flow;
        largest = std::max(largest, std::abs(flow));
    }
    double most = 0;
    for (const double one : left) most = std::max(most, std::abs(one));
    return largest > 0 ? most / largest : most;
}

}  // namespace

TEST_CASE("a pool gives all wishes the same share, and keeps what is left", "[carbon]") {
    Environment poor = carbon_process("seed = 3\nyield = 0.75\n");
    AskingPlants plants = plant_with({wish(1), wish(2), wish(3)});
    plants.exchange(poor, 0);
    const std::vector<double> granted = plants.parameters();
    for (int k = 0; k < 3; ++k) CHECK(granted[k] == Approx((k + 1) * 3 * 0.75 / 6));
    CHECK(of(poor, "carbon.built") == Approx(2.25));
    CHECK(of(poor, "carbon.growth") == Approx(0.75));
    CHECK(of(poor, "carbon.reserve") == Approx(0).margin(1e-15));

    Environment rich = carbon_process("seed = 20\nyield = 0.8\n");
    AskingPlants others = plant_with({wish(1), wish(2), wish(3)});
    others.exchange(rich, 0);
    CHECK(others.parameters()[2] == 3);
    CHECK(of(rich, "carbon.reserve") == Approx(20 - 6 / 0.8));
}

TEST_CASE("maintenance follows mass, time and temperature, and is paid first", "[carbon]") {
    for (const double celsius : {5.0, 25.0, 33.0}) {
        Environment environment = carbon_process(fmt::format(
            "seed = 10\nmaintenance = 0.02\nq10 = 2.2\ntemperature = {}\ndays = 0.5\nyield = 0.7\n", celsius));
        AskingPlants plants = plant_with({wish(0, {4}), wish(0, {1})});
        plants.exchange(environment, 0);
        CHECK(of(environment, "carbon.maintenance") == 0);
        plants.exchange(environment, 1);
        const double expected = 0.02 * 5 * 0.5 * std::pow(2.2, (celsius - 25) / 10);
        CHECK(of(environment, "carbon.maintenance") == Approx(expected).epsilon(1e-12));
        CHECK(of(environment, "carbon.reserve") == Approx(10 - expected).epsilon(1e-12));
    }
    Environment leafy = carbon_process("seed = 10\nmaintenance = 0.02\ntemperature = 25\n");
    AskingPlants leaf = plant_with({wish(0, {4, 0, 0}), wish(0, {1, 0.5, 0})});
    leaf.exchange(leafy, 1);
    CHECK(of(leafy, "carbon.maintenance") == Approx(0.01));
    CHECK(leaf.parameters()[3] == Approx(9.99));

    Environment starving = carbon_process("seed = 0.01\nmaintenance = 0.02\ntemperature = 25\n");
    AskingPlants plants = plant_with({wish(5, {2})});
    plants.exchange(starving, 1);
    CHECK(plants.parameters()[0] == 0);
    CHECK(of(starving, "carbon.maintenance") == Approx(0.01));
    CHECK(of(starving, "carbon.unpaid") == Approx(0.03));
}

TEST_CASE("organs that are gone take their carbon away, and new ones bring theirs", "[carbon]") {
    Environment environment = carbon_process("seed = 2\nmaintenance = 0\nyield = 1\n");
    AskingPlants first = plant_with({wish(1, {3}), wish(0, {4})});
    first.exchange(environment, 0);
    CHECK(of(environment, "carbon.structure") == Approx(8));
    AskingPlants second = plant_with({wish(0, {4})});
    second.exchange(environment, 1);
    CHECK(of(environment, "carbon.shed") == Approx(4));
    CHECK(of(environment, "carbon.structure") == Approx(4));
    CHECK(std::abs(of(environment, "carbon.balance")) < 1e-14);
}

TEST_CASE("organs that give fill the pool with the time that has passed", "[carbon]") {
    Environment environment = carbon_process("maintenance = 0\nyield = 1\n");
    AskingPlants plants = plant_with({wish(-2.5), wish(1)});
    plants.exchange(environment, 0);
    CHECK(plants.parameters() == std::vector<double>{-2.5, 0});
    AskingPlants later = plant_with({wish(-2.5), wish(1)});
    later.exchange(environment, 1);
    CHECK(later.parameters() == std::vector<double>{-2.5, 1});
    CHECK(of(environment, "carbon.reserve") == Approx(1.5));
}

TEST_CASE("transport along an axis is the closed form of a steady source and a sink", "[carbon]") {
    // A source of 2 g/d at the tip of ten nodes, a sink at the base: in the steady state the same flow everywhere.
    std::vector<SugarNode> nodes(10);
    for (std::uint32_t i = 0; i < 10; ++i) {
        nodes[i].volume = 0.7;
        if (i > 0) nodes[i].bearer = i - 1, nodes[i].conductance = 25 + i;
    }
    nodes.front().sink = 5;
    nodes.back().source = 2;
    const HalfSaturation half{0.05, 0.0025};
    SugarTransport transport;
    for (int step = 0; step < 400; ++step) {
        const std::vector<double>& c = transport.concentrations(nodes, 1, half);
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].sugar = nodes[i].volume * c[i];
    }
    double expected = 0.05 * 2 / (5 - 2);  // 5 C / (half + C) = 2
    for (std::uint32_t i = 0; i < 10; ++i) {
        if (i > 0) expected += 2 / nodes[i].conductance;
        CHECK(nodes[i].sugar / nodes[i].volume == Approx(expected).epsilon(1e-10));
    }
}

TEST_CASE("transport holds its equations on any tree, with no concentration below zero", "[carbon]") {
    std::mt19937 random(20261129);
    for (int trial = 0; trial < 60; ++trial) {
        const std::vector<SugarNode> nodes = any_tree(random, 1 + trial * 13);
        const double days = std::pow(10, trial % 7 - 4);
        const HalfSaturation half{0.01 + 0.01 * (trial % 5), 0.001};
        SugarTransport transport;
        const std::vector<double>& c = transport.concentrations(nodes, days, half);
        CHECK(*std::min_element(c.begin(), c.end()) >= 0);
        CHECK(imbalance(nodes, c, days, half) < 1e-11);
    }
}

namespace {

/// A stem of five internodes that bears a fruit at the second and the fourth, a leaf that gives 1 g at the third, and
/// whose root, at the first, grows. Radii in metres.
AskingPlants fruiting_stem(std::vector<double> radii, double fruit_above = 2) {
    AskingPlants plants = plant_with({wish(1), wish(2), wish(-1), wish(fruit_above), wish(0)});
    Interpretation& drawn = plants.interpretation(0);
    for (std::uint32_t i = 0; i < 5; ++i) {
        Internode internode{};
        internode.module = i;
        internode.base = {0, 0.05 * i, 0};
        internode.tip = {0, 0.05 * (i + 1), 0};
        internode.base_radius = internode.tip_radius = radii[i];
        drawn.geometry.internodes.push_back(internode);
        drawn.queries[i].pose.position = internode.tip;
    }
    return plants;
}

const std::string transport = "share = \"transport\"\nmaintenance = 0\nseed = 0.2\n";

double fed(double radius_of_second, double fruit_above, std::size_t organ) {
    Environment environment = carbon_process(transport);
    double granted = 0;
    for (int step = 1; step <= 6; ++step) {
        AskingPlants plants = fruiting_stem({0.004, radius_of_second, 0.004, 0.004, 0.004}, fruit_above);
        plants.exchange(environment, step);
        granted = plants.parameters()[organ];
        REQUIRE(std::abs(of(environment, "carbon.balance")) < 1e-12);
    }
    return granted;
}

}  // namespace

TEST_CASE("a girdle keeps sugar above it", "[carbon]") {
    // The leaf and the upper fruit stand above the second internode, root and lower fruit at it or below.
    CHECK(fed(0, 2, 0) < 0.1 * fed(0.004, 2, 0));
    CHECK(fed(0, 2, 3) > 1.2 * fed(0.004, 2, 3));
}

TEST_CASE("a plant that sheds all its internodes loses their sugar", "[carbon]") {
    Environment environment = carbon_process(transport);
    AskingPlants standing = fruiting_stem({0.004, 0.004, 0.004, 0.004, 0.004});
    standing.exchange(environment, 1);
    const double reserve = of(environment, "carbon.reserve");
    CHECK(reserve > 0);
    AskingPlants stump = plant_with({wish(1)});
    stump.exchange(environment, 2);
    CHECK(of(environment, "carbon.shed") == Approx(reserve));
    CHECK(stump.parameters()[0] == 0);
    CHECK(std::abs(of(environment, "carbon.balance")) < 1e-12);
}

TEST_CASE("fewer fruits become larger ones, and the nearer sink gets more", "[carbon]") {
    CHECK(fed(0.004, 0, 1) > 1.2 * fed(0.004, 2, 1));
    // Two fruits with one wish: the one beside the leaf's own side of the stem, and one across a thin internode.
    CHECK(fed(0.0005, 2, 3) > fed(0.0005, 2, 1));
}

TEST_CASE("a checkpoint keeps reserve, structure and balance", "[carbon]") {
    const std::string lines = "seed = 9\nmaintenance = 0.01\nshare = \"transport\"\n";
    Environment environment = carbon_process(lines);
    AskingPlants plants = plant_with({wish(1, {2}), wish(-0.4, {1})});
    plants.exchange(environment, 1);
    std::stringstream kept;
    environment.save(kept);
    Environment again = carbon_process(lines);
    again.restore(kept);
    AskingPlants next = plant_with({wish(1, {2.1}), wish(-0.4, {1})});
    AskingPlants same = plant_with({wish(1, {2.1}), wish(-0.4, {1})});
    next.exchange(environment, 2);
    same.exchange(again, 2);
    CHECK(next.parameters() == same.parameters());
    for (const char* name : {"carbon.reserve", "carbon.structure", "carbon.balance"}) {
        CHECK(of(again, name) == of(environment, name));
    }
}

TEST_CASE("what carbon cannot work with is told", "[carbon]") {
    Environment environment = carbon_process("seed = 1\n");
    AskingPlants mixed = plant_with({wish(1), wish(1, {2})});
    CHECK_THROWS_WITH(mixed.exchange(environment, 0), Contains("give all of them a second parameter"));
    AskingPlants negative = plant_with({wish(1, {-2})});
    CHECK_THROWS_WITH(negative.exchange(environment, 0),
                      Contains("an organ cannot have -2 g that take 1 of the maintenance"));
    Environment lost = carbon_process("leaves = \"leaves\"\n");
    AskingPlants plants = plant_with({wish(1)});
    CHECK_THROWS_WITH(plants.exchange(lost, 0), Contains("needs a leaf-exchange called 'leaves'"));
}
