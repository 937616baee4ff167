// models/roots: the law of growth, whatever the length of a step, and the response of laterals to nitrate.
#include "catch.h"
#include "experiments/growth.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <set>

using namespace espalier;

namespace {

struct Order {
    double length = 0;  ///< of all axes, m
    std::size_t axes = 0;
};

/// By order of branching, of the axes that are drawn.
std::map<int, Order> roots_after(const std::string& name, double days, double step) {
    LonePlant plant("models/roots/" + name + ".l", {{"DT", fmt::format("{}", step)}}, 3);
    plant.grow(static_cast<int>(std::lround(days / step)));
    std::map<int, Order> orders;
    std::map<int, std::set<std::uint32_t>> axes;
    const auto& internodes = plant.interpretation.geometry.internodes;
    // Orders by widths, which all differ.
    std::set<float, std::greater<>> widths;
    for (const Internode& internode : internodes) widths.insert(static_cast<float>(internode.tip_radius));
    for (const Internode& internode : internodes) {
        const auto at = widths.find(static_cast<float>(internode.tip_radius));
        const int order = static_cast<int>(std::distance(widths.begin(), at));
        orders[order].length += glm::length(internode.tip - internode.base);
        axes[order].insert(internode.axis);
    }
    for (auto& [order, of_order] : orders) of_order.axes = axes[order].size();
    return orders;
}

double length_after(double k, double r, double days) {
    return k * (1 - std::exp(-r * days / k));
}

}  // namespace

TEST_CASE("roots: lengths and numbers of axes do not depend on the length of a step", "[roots-models]") {
    for (const std::string name : {"maize", "wheat", "lupine", "split"}) {
        const auto coarse = roots_after(name, 20, 2), fine = roots_after(name, 20, 0.25);
        REQUIRE(coarse.size() == 3);
        for (int order = 0; order < 3; ++order) {
            INFO(name << ", order " << order);
            CHECK(coarse.at(order).axes == fine.at(order).axes);
            CHECK(coarse.at(order).length == Approx(fine.at(order).length).epsilon(1e-5));
        }
    }
}

TEST_CASE("roots: a taproot has the length of the negative exponential, and its laterals those of their ages",
          "[roots-models]") {
    const auto lupine = roots_after("lupine", 30, 1);
    CHECK(lupine.at(0).axes == 1);
    CHECK(lupine.at(0).length == Approx(length_after(1.5, 0.025, 30)).epsilon(1e-9));
    double length = 0;
    std::size_t laterals = 0;
    for (double place = 0.006; place < 1.5; place += 0.006) {
        const double age = 30 + 1.5 / 0.025 * std::log(1 - place / 1.5) - 5;
        if (age <= 0) break;
        ++laterals;
        length += length_after(0.2, 0.01, age);
    }
    CHECK(lupine.at(1).axes == laterals);
    CHECK(lupine.at(1).length == Approx(length).epsilon(1e-5));
}

TEST_CASE("roots: maize has a primary root, seminal roots and whorls at their time", "[roots-models]") {
    CHECK(roots_after("maize", 7, 1).at(0).axes == 1 + 4);
    CHECK(roots_after("maize", 9, 1).at(0).axes == 1 + 4 + 4);
    CHECK(roots_after("maize", 14, 1).at(0).axes == 1 + 4 + 4 + 5);
    CHECK(roots_after("wheat", 14, 1).at(0).axes == 5);
    CHECK(roots_after("wheat", 20, 1).at(0).axes == 5 + 2 * 2);
}
