// models/roots: the law of growth, whatever the length of a step, and the response of laterals to nitrate.
#include "catch.h"
#include "experiments/growth.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

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

namespace {

/// What the tips of a model ask beside `nitrate`.
std::string asked_by(const std::string& model) {
    const auto profile = [](const std::string& name, const std::string& table) {
        return fmt::format("[environment.{}]\nprocess = \"profile\"\nfile = \"environments/soils/{}.csv\"\n", name,
                           table);
    };
    if (model == "impeded") return profile("strength", "loose") + profile("temperature", "summer");
    return model == "mortal" ? profile("head", "wet") : "";
}

/// A root system of 25 days in a pot 16 cm wide and 12 cm deep; `soil`: more of the soil.
std::unique_ptr<World> in_pot(const std::string& model, double step, const std::string& soil = "") {
    const Scene scene = read_scene_text(
        fmt::format("[simulation]\nsteps = {}\nseed = 4\ndt = {}\n[[plant]]\nmodel = \"models/roots/{}.l\"\n"
                    "position = [0, {}, 0]\n{}{}[environment.nitrate]\nprocess = \"nutrient\"\n"
                    "domain = {{ lower = [-0.08, -0.12, -0.08], upper = [0.08, 0, 0.08] }}\nvoxel = 0.02\n"
                    "initial = 10\n{}",
                    static_cast<int>(25 / step), step, model, model == "split" ? 0.001 : 0.0,
                    model == "barley" ? "" : fmt::format("define = {{ DT = {} }}\n", step), asked_by(model), soil),
        "pot", source_path(""), {});
    auto world = std::make_unique<World>(scene);
    world->start();
    while (!world->at_end()) world->step();
    return world;
}

double length_of(const World& world) {
    double length = 0;
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        length += glm::length(internode.tip - internode.base);
    }
    return length;
}

}  // namespace

TEST_CASE("roots: tips stop at the walls and the floor of a pot, whatever the length of a step", "[roots-models]") {
    for (const std::string model : {"maize", "wheat", "lupine", "split", "impeded", "mortal", "barley"}) {
        for (const double step : {0.5, 1.0, 2.5}) {
            if (model == "barley" && step != 0.5) continue;  // it has a step of its own
            INFO(model << ", steps of " << step << " d");
            const auto pot = in_pot(model, step);
            int at_wall = 0;
            for (const Internode& internode : pot->interpretation(0).geometry.internodes) {
                const glm::dvec3& tip = internode.tip;
                const double room = std::min({0.08 - std::abs(tip.x), 0.08 - std::abs(tip.z), tip.y + 0.12});
                CHECK(room > 0);
                at_wall += room < 0.003;
            }
            CHECK(at_wall > 0);
            CHECK(pot->warnings().empty());
        }
    }
}

TEST_CASE("roots: tips stop at a stone, and go through where soil has no sides", "[roots-models]") {
    const std::string stone = "obstacles = [{ shape = \"sphere\", center = [0.02, -0.05, 0], radius = 0.02 }]\n";
    const auto with_stone = in_pot("maize", 1, stone);
    for (const Internode& internode : with_stone->interpretation(0).geometry.internodes) {
        CHECK(glm::length(internode.tip - glm::dvec3(0.02, -0.05, 0)) > 0.02);
    }
    const auto pot = in_pot("maize", 1), field = in_pot("maize", 1, "sides = \"periodic\"\n");
    CHECK(length_of(*field) > 1.1 * length_of(*pot));
    double widest = 0;
    for (const Internode& internode : field->interpretation(0).geometry.internodes) {
        widest = std::max(widest, std::abs(internode.tip.x));
        CHECK(internode.tip.y > -0.12);
    }
    CHECK(widest > 0.08);
}

TEST_CASE("roots: pieces say their age since the tip has passed, whatever the length of a step", "[roots-models]") {
    for (const double step : {0.5, 2.0}) {
        LonePlant plant("models/roots/lupine.l", {{"DT", fmt::format("{}", step)}, {"AGES", "1"}, {"WIGGLE", "0"}}, 3);
        plant.grow(static_cast<int>(std::lround(20 / step)));
        int told = 0;
        for (const Query& query : plant.interpretation.queries) {
            if (query.parameters.size() != 5) continue;
            const glm::dvec3& at = query.pose.position;
            if (std::hypot(at.x, at.z) > 1e-6) continue;
            const double passed = -1.5 / 0.025 * std::log(1 + at.y / 1.5);
            CHECK(query.parameters[4] == Approx(20 - passed).margin(1e-6));
            ++told;
        }
        CHECK(told > 50);
    }
}

namespace {

struct TreeAxis {
    int order = 0;
    double length = 0;
    glm::dvec3 base{0}, tip{0};
};

/// The axes of 25 years, longest first.
std::vector<TreeAxis> tree_axes(double step, std::uint64_t seed) {
    LonePlant plant("models/roots/tree.l", {{"DT", fmt::format("{}", step)}}, seed);
    plant.grow(static_cast<int>(std::lround(25 / step)));
    std::map<std::uint32_t, TreeAxis> axes;
    for (const Internode& internode : plant.interpretation.geometry.internodes) {
        TreeAxis& axis = axes[internode.axis];
        if (axis.length == 0) axis.base = internode.base;
        axis.order = internode.order;
        axis.length += glm::length(internode.tip - internode.base);
        axis.tip = internode.tip;
    }
    std::vector<TreeAxis> sorted;
    for (const auto& [number, axis] : axes) sorted.push_back(axis);
    std::sort(sorted.begin(), sorted.end(), [](const TreeAxis& a, const TreeAxis& b) { return a.length > b.length; });
    return sorted;
}

}  // namespace

TEST_CASE("roots: taproot and main roots of a tree have the lengths of the law of growth", "[roots-models]") {
    for (const double step : {1.0, 0.25}) {
        const std::vector<TreeAxis> axes = tree_axes(step, 5);
        for (int k = 0; k < 7; ++k) {
            const double place = (k + 1) * 0.3 / 7;
            const double age = 25 + 1.6 / 0.4 * std::log(1 - place / 1.6) - 1;
            CHECK(axes[static_cast<std::size_t>(k)].order == 1);
            CHECK(axes[static_cast<std::size_t>(k)].length == Approx(length_after(9, 0.6, age)).epsilon(1e-5));
        }
        const auto taproot =
            std::find_if(axes.begin(), axes.end(), [](const TreeAxis& axis) { return axis.order == 0; });
        CHECK(taproot->length == Approx(length_after(1.6, 0.4, 25)).epsilon(1e-5));
    }
}

TEST_CASE("roots: main roots of a tree stay shallow and in the ground, and sinkers are steep", "[roots-models]") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        INFO("seed " << seed);
        const std::vector<TreeAxis> axes = tree_axes(1, seed);
        int sinkers = 0;
        for (const TreeAxis& axis : axes) {
            const glm::dvec3 reach = axis.tip - axis.base;
            const double aside = std::hypot(reach.x, reach.z);
            CHECK(axis.tip.y < 0);
            if (axis.order == 1 && axis.length > 5) {
                CHECK(axis.tip.y > -1.6);
                CHECK(aside > 0.6 * axis.length);
            }
            // Laterals stand on main roots at 65 degrees to the side.
            if (axis.order == 2 && axis.length > 0.5 && -reach.y > aside) {
                ++sinkers;
                CHECK(-reach.y > 3 * aside);
            }
        }
        CHECK(sinkers > 15);
    }
}
