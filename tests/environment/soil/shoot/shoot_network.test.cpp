// Water in shoots against closed forms and a slow solver of its own.
#include "environment/soil/shoot/shoot_network.h"

#include "catch.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace espalier::environment;

namespace {

ShootLosses constant(double rate) {
    return [rate](std::span<const double>, std::span<LossOfHead> losses) {
        for (LossOfHead& loss : losses) loss = {rate, 0};
    };
}

/// Stomata that close over some thousand cm, and a leaf that dries at last.
struct Closing {
    double most, middle, width;

    double at(double head) const {
        const double open = 1 / (1 + std::exp((middle - head) / width));
        const double dry = head < -5e4 ? std::exp((head + 5e4) / 5e3) : 1;
        return most * (0.05 * dry + 0.95 * open);
    }
};

ShootLosses closing(const std::vector<Closing>& leaves) {
    return [&leaves](std::span<const double> heads, std::span<LossOfHead> losses) {
        for (std::size_t i = 0; i < heads.size(); ++i) {
            const double step = 0.1;
            losses[i] = {leaves[i].at(heads[i]),
                         (leaves[i].at(heads[i] + step) - leaves[i].at(heads[i] - step)) / (2 * step)};
        }
    };
}

ShootPast nothing_before(std::size_t nodes) {
    return {std::vector<double>(nodes, 0), std::vector<double>(nodes, 0)};
}

/// By the middle of many pieces.
double slow_mean(const Vulnerability& conduits, double a, double b) {
    constexpr int pieces = 20000;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double head = a + (b - a) * (i + 0.5) / pieces;
        sum += head >= 0 ? 1 : std::exp(-std::pow(-head / conduits.head, conduits.power));
    }
    return sum / pieces;
}

/// Any shoot of up to so many internodes, with a leaf on every third.
struct AnyShoot {
    std::vector<ShootNode> nodes;
    std::vector<Closing> leaves;

    AnyShoot(std::mt19937& random, std::size_t internodes, double spread = 3) {
        std::uniform_real_distribution<> unit(0, 1);
        const Vulnerability stem{5000 + 30000 * unit(random), 1 + 5 * unit(random)};
        const Vulnerability blade{5000 + 20000 * unit(random), 1 + 5 * unit(random)};
        for (std::size_t i = 0; i < internodes; ++i) {
            ShootNode node;
            if (i > 0 && unit(random) < 0.95)
                node.bearer = static_cast<std::uint32_t>(unit(random) * static_cast<double>(i));
            node.conductance = std::pow(10, spread * (unit(random) - 1));
            node.conduits = stem;
            node.height = (node.bearer == ShootNode::collar ? 0 : nodes[node.bearer].height) + 5 * unit(random);
            nodes.push_back(node);
        }
        for (std::size_t i = 0; i < internodes; i += 3) {
            ShootNode leaf{static_cast<std::uint32_t>(i), std::pow(10, -1 - spread * unit(random)), blade,
                           nodes[i].height + 1};
            leaf.is_leaf = true;
            nodes.push_back(leaf);
            leaves.push_back({std::pow(10, -2 + 4 * unit(random)), -3e4 * unit(random), 500 + 4000 * unit(random)});
        }
    }
};

/// Each head in turn is brought to where its own balance holds, by bisection, until none moves.
std::vector<double> slow_heads(const AnyShoot& shoot, const CollarView& supply) {
    const std::size_t count = shoot.nodes.size(), first_leaf = count - shoot.leaves.size();
    std::vector<double> heads(count + 1, 0);  // the last is the collar's
    const auto head_of = [&](std::uint32_t node) { return node == ShootNode::collar ? heads[count] : heads[node]; };
    const auto height_of = [&](std::uint32_t node) { return node == ShootNode::collar ? 0 : shoot.nodes[node].height; };
    const auto flow = [&](std::size_t i) {
        const ShootNode& node = shoot.nodes[i];
        const double below = head_of(node.bearer), own = heads[i];
        return node.conductance * mean_left(node.conduits, below, own).mean *
               (below + height_of(node.bearer) - own - node.height);
    };
    const auto surplus = [&](std::size_t i) {
        double sum = i < count ? flow(i) : supply.conductance * (supply.head - heads[count]);
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t bearer = shoot.nodes[k].bearer;
            if (bearer == (i < count ? static_cast<std::uint32_t>(i) : ShootNode::collar)) sum -= flow(k);
        }
        return i >= first_leaf && i < count ? sum - shoot.leaves[i - first_leaf].at(heads[i]) : sum;
    };
    for (int sweep = 0; sweep < 20000; ++sweep) {
        double moved = 0;
        for (std::size_t i = 0; i <= count; ++i) {
            const double before = heads[i];
            double low = -3e5, high = 1e4;
            for (int k = 0; k < 70; ++k) {
                heads[i] = 0.5 * (low + high);
                (surplus(i) > 0 ? low : high) = heads[i];
            }
            moved = std::max(moved, std::abs(heads[i] - before));
        }
        if (moved < 1e-9) break;
    }
    return heads;
}

}  // namespace

TEST_CASE("a stem carries the integral of its conductance over the potential", "[shoot]") {
    // Kmax 5 mmol m-2 s-1 MPa-1, b 3 MPa, c 3, between -0.5 and -2 MPa.
    const Vulnerability stem{3, 3};
    CHECK(5 * 1.5 * mean_left(stem, -0.5, -2).mean == Approx(6.82076).epsilon(1e-6));
    for (const double power : {1.0, 1.5, 2.7, 6.0, 20.0}) {
        const Vulnerability conduits{2.2, power};
        for (const auto& [a, b] : {std::pair{0.3, -1.0}, {-0.2, -2.2}, {-3.0, -0.7}, {-1.5, -1.5004}, {-1.0, -9.0}}) {
            INFO("c " << power << ", from " << a << " to " << b);
            CHECK(mean_left(conduits, a, b).mean == Approx(slow_mean(conduits, a, b)).epsilon(2e-6).margin(1e-11));
        }
        CHECK(conduits.left(-2.2) == Approx(std::exp(-1)));
        CHECK(conduits.left(0.1) == 1);
    }
}

TEST_CASE("the mean conductance changes with both potentials as its tangents say", "[shoot]") {
    for (const double power : {1.0, 3.0, 8.0}) {
        const Vulnerability conduits{2, power};
        for (const auto& [a, b] : {std::pair{0.2, -1.0}, {-0.5, -2.5}, {-1.3, -1.3000001}, {-2.0, -1.0}}) {
            const double step = 1e-6;
            const MeanLeft at = mean_left(conduits, a, b);
            const double by_a =
                (mean_left(conduits, a + step, b).mean - mean_left(conduits, a - step, b).mean) / (2 * step);
            const double by_b =
                (mean_left(conduits, a, b + step).mean - mean_left(conduits, a, b - step).mean) / (2 * step);
            CHECK(at.by_first == Approx(by_a).epsilon(1e-4).margin(1e-7));
            CHECK(at.by_second == Approx(by_b).epsilon(1e-4).margin(1e-7));
        }
    }
}

TEST_CASE("without losses of conductance a shoot is a chain of resistances that hangs by its weight", "[shoot]") {
    // A stem of 40 cm with a branch; leaves that draw 3 cm3/d each.
    const double k[] = {0.2, 0.5, 0.1, 0.05, 0.04};
    std::vector<ShootNode> nodes{
        {ShootNode::collar, k[0], {}, 20}, {0, k[1], {}, 40}, {0, k[2], {}, 25}, {1, k[3], {}, 41}, {2, k[4], {}, 26}};
    nodes[3].is_leaf = nodes[4].is_leaf = true;
    ShootNetwork shoot(nodes, 0);
    shoot.rest_at(-100);
    shoot.solve({0.8, -100}, constant(3), nothing_before(5), 0, 1);
    const std::vector<double>& head = shoot.flow().head;
    const double collar = -100 - 6 / 0.8, fork = collar - 20 - 6 / k[0];
    CHECK(shoot.flow().collar_head == Approx(collar));
    CHECK(head[0] == Approx(fork));
    CHECK(head[3] == Approx(fork - 20 - 3 / k[1] - 1 - 3 / k[3]));
    CHECK(head[4] == Approx(fork - 5 - 3 / k[2] - 1 - 3 / k[4]));
    CHECK(shoot.flow().intake == Approx(6));
    // At rest nothing flows, and the heads hang from the soil's.
    shoot.solve({0.8, -100}, constant(0), nothing_before(5), 0, 1);
    CHECK(head[3] == Approx(-141));
    CHECK(std::abs(shoot.flow().intake) < 1e-10);
}

TEST_CASE("any shoot has the potentials that a slow solver finds, whatever it begins with", "[shoot]") {
    std::mt19937 random(20261130);
    std::uniform_real_distribution<> unit(0, 1);
    for (int trial = 0; trial < 12; ++trial) {
        const AnyShoot shoot(random, 2 + trial % 4, 1);
        const CollarView supply{std::pow(10, -2 + 2 * unit(random)), -8000 * unit(random)};
        const std::vector<double> slow = slow_heads(shoot, supply);
        for (const double start : {0.0, supply.head, -6e4}) {
            INFO("trial " << trial << ", from " << start);
            ShootNetwork network(shoot.nodes, 0);
            network.rest_at(start);
            network.solve(supply, closing(shoot.leaves), nothing_before(shoot.nodes.size()), 0, 1);
            CHECK(network.flow().residual < 1e-10);
            for (std::size_t i = 0; i < shoot.nodes.size(); ++i)
                CHECK(network.flow().head[i] == Approx(slow[i]).epsilon(1e-5));
            CHECK(network.flow().collar_head == Approx(slow.back()).epsilon(1e-5));
        }
    }
}

TEST_CASE("large shoots are solved whatever their leaves ask for", "[shoot]") {
    std::mt19937 random(77);
    std::uniform_real_distribution<> unit(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const AnyShoot shoot(random, 20 + trial * 3);
        const CollarView supply{std::pow(10, -9 + 10 * unit(random)), -1.5e4 * unit(random)};
        ShootNetwork network(shoot.nodes, 0);
        network.rest_at(supply.head);
        network.solve(supply, closing(shoot.leaves), nothing_before(shoot.nodes.size()), 0, 1);
        INFO("trial " << trial);
        CHECK(network.flow().residual < 1e-9);
    }
}

TEST_CASE("a leaf gets no more than the ceiling of its conduits, whatever it could give", "[shoot]") {
    // The integral of exp(-(x/b)^c) to infinity is b Gamma(1 + 1/c).
    const double b = 20000, c = 3, conductance = 1e-3;
    const double ceiling = conductance * b * std::tgamma(1 + 1 / c);
    ShootNode leaf{ShootNode::collar, conductance, {b, c}, 0};
    leaf.is_leaf = true;
    for (const double demand : {0.5, 0.99, 1.5, 10.0, 1000.0}) {
        const std::vector<Closing> closes{{demand * ceiling, -40000, 2000}};
        ShootNetwork shoot({leaf}, 0);
        shoot.rest_at(0);
        shoot.solve({1e6, 0}, closing(closes), nothing_before(1), 0, 1);
        CHECK(shoot.flow().residual < 1e-10);
        CHECK(shoot.flow().intake < (1 + 1e-9) * ceiling);
        if (demand < 1) CHECK(shoot.flow().intake > 0.98 * demand * ceiling);
        if (demand > 1) CHECK(shoot.flow().intake > 0.9 * ceiling);
    }
}

TEST_CASE("a store that fills through a resistance follows the exponential, and keeps the balance", "[shoot]") {
    const double conductance = 0.5, capacity = 0.02, tau = capacity / conductance;
    ShootNode leaf{ShootNode::collar, conductance, {}, 0, capacity};
    leaf.is_leaf = true;
    const auto missed = [&](int steps) {
        ShootNetwork shoot({leaf}, 0);
        shoot.rest_at(-1000);
        ShootPast past{{-1000}, {0}};
        double taken = 0;
        for (int k = 0; k < steps; ++k) {
            const double days = 2 * tau / steps;
            shoot.solve({1e5, -100}, constant(0.3), past, days, 1);
            taken += (shoot.flow().intake - 0.3) * days;
            past = {shoot.flow().head, shoot.flow().stored};
        }
        CHECK(taken == Approx(capacity * (past.head[0] + 1000)).epsilon(1e-8));
        const double rest = -100 - 0.3 / conductance;
        return std::abs(past.head[0] - (rest + (-1000 - rest) * std::exp(-2)));
    };
    CHECK(missed(50) / missed(100) == Approx(2).epsilon(0.05));
    CHECK(missed(400) < 1);
}
