#include "catch.h"
#include "turtle/stages/tree.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

/// A stem of a length and a radius that falls to nothing, in pieces.
Tree pole(double length, double radius, int pieces = 8) {
    Tree tree;
    for (int i = 0; i < pieces; ++i) tree.grow({0, length / pieces, 0}, radius);
    for (int i = 0; i < pieces; ++i) {
        Internode& internode = tree.geometry.internodes[std::size_t(i)];
        internode.base_radius = radius * (1 - double(i) / pieces);
        internode.tip_radius = radius * (1 - double(i + 1) / pieces);
    }
    return tree;
}

glm::dvec3 tip_of_pole(double length, double radius, double time, Settings parameters = {{"speed", 1}}) {
    parameters.put("stage", "sway");
    Tree tree = pole(length, radius);
    return tree.stage(parameters, time)[tree.size() - 1].tip;
}

/// The mean frequency of a movement: half the number of its changes of sign.
double frequency_of_pole(double length, double radius) {
    constexpr double duration = 2000;
    int changes = 0;
    double before = tip_of_pole(length, radius, 0).x;
    for (double time = 0.5; time < duration; time += 0.5) {
        const double now = tip_of_pole(length, radius, time).x;
        changes += now * before < 0;
        before = now;
    }
    return changes / duration / 2;
}

}  // namespace

TEST_CASE("without wind nothing sways, to the last bit, at any time", "[turtle][stages]") {
    const Settings calm{{"stage", "sway"}, {"speed", 0}};
    CHECK(same(small_tree().stage(calm, 3.7), small_tree()));
}

TEST_CASE("a pole's amplitude is what Weber and Penn have, and grows with the speed and the gust", "[turtle][stages]") {
    // With a cone, a0 = 4 L / r at any height, so that the tip turns by a1 sin b + a2 sin 0.7 b about each of two axes.
    const double a0 = 4 * 10 / 0.5;
    for (const auto& [speed, gust] : {std::pair{0.5, 0.0}, {1.0, 0.0}, {1.0, 2.0}}) {
        double greatest = 0;
        for (double time = 0; time < 400; time += 0.1) {
            Tree tree = pole(10, 0.5);
            tree.stage({{"stage", "sway"}, {"speed", speed}, {"gust", gust}}, time);
            const glm::dvec3 top = tree[7].tip - tree[7].base;
            greatest = std::max(greatest, glm::degrees(std::asin(std::abs(top.x) / glm::length(top))));
        }
        const double a1 = speed / 50 * a0, a2 = gust / 50 * a0 + a1 / 2;
        CHECK(greatest == Approx(a1 + a2).epsilon(0.02));
    }
}

TEST_CASE("long stems sway slowly, thick stems fast", "[turtle][stages]") {
    const double once = frequency_of_pole(10, 0.2);
    CHECK(frequency_of_pole(20, 0.2) == Approx(once / 2).epsilon(0.05));
    CHECK(frequency_of_pole(10, 0.4) == Approx(2 * once).epsilon(0.05));
    // Between the two frequencies of which the movement is the sum, nearer to the stronger.
    const double fast = 100 * 0.2 / 10 / (2 * std::numbers::pi);
    CHECK(once > 0.7 * fast);
    CHECK(once < 1.01 * fast);
}

TEST_CASE("a stem sways the same in many pieces as in few", "[turtle][stages]") {
    const auto tip = [](int pieces) {
        Tree tree = pole(10, 0.3, pieces);
        return tree.stage({{"stage", "sway"}, {"speed", 2}}, 1.25)[std::size_t(pieces) - 1].tip;
    };
    const glm::dvec3 fine = tip(256);
    CHECK(glm::distance(tip(8), fine) < 0.3 * glm::distance(tip(2), fine));
    CHECK(glm::distance(tip(64), fine) < 0.01);
}

TEST_CASE("swaying keeps lengths and joints, and moves what a stem bears with it", "[turtle][stages]") {
    const Tree before = small_tree();
    const Tree after = small_tree().stage({{"stage", "sway"}, {"speed", 4}, {"gust", 3}}, 0.8);
    CHECK_FALSE(same(before, after));
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after.length(i) == Approx(before.length(i)).epsilon(1e-12));
        for (std::size_t k = 0; k < before.size(); ++k) {
            CHECK((glm::distance(after[i].tip, after[k].base) < 1e-12) == (before[i].tip == before[k].base));
        }
    }
    const glm::dvec3 organ = after.geometry.organs[0].pose.position;
    CHECK(glm::distance(organ, after[3].tip) ==
          Approx(glm::distance(before.geometry.organs[0].pose.position, before[3].tip)).margin(1e-12));
}

TEST_CASE("an axis goes on in the thickest branch of its end", "[turtle][stages]") {
    const auto tip = [](double first, double second) {
        Tree tree;
        tree.grow({0, 1, 0}, 0.1).open().grow({0, 1, 0}, first).close().open().grow({0, 1, 0}, second).close();
        tree.stage({{"stage", "sway"}, {"speed", 1}}, 0);
        return std::pair{tree[1].tip, tree[2].tip};
    };
    Tree pole_of_two;
    pole_of_two.grow({0, 1, 0}, 0.1).grow({0, 1, 0}, 0.08).stage({{"stage", "sway"}, {"speed", 1}}, 0);
    CHECK(glm::distance(tip(0.02, 0.08).second, pole_of_two[1].tip) < 1e-12);
    CHECK(glm::distance(tip(0.08, 0.02).first, pole_of_two[1].tip) < 1e-12);
}

TEST_CASE("thin stems bend no further than allowed, and lines without radius not at all", "[turtle][stages]") {
    for (double time = 0; time < 20; time += 0.5) {
        Tree thread = pole(10, 1e-6);
        thread.stage({{"stage", "sway"}, {"speed", 5}, {"most", 30}, {"pace", 1e7}}, time);
        const glm::dvec3 top = thread[7].tip - thread[7].base;
        CHECK(glm::degrees(std::asin(std::abs(top.x) / glm::length(top))) <= 30 + 1e-6);
    }
    const Settings wind{{"stage", "sway"}, {"speed", 5}};
    CHECK(same(pole(10, 0).stage(wind, 2), pole(10, 0)));
}

TEST_CASE("sway refuses winds that are none", "[turtle][stages]") {
    const auto error = [](const std::string& line) { return refusal("stage = 'sway'\n" + line); };
    CHECK_THAT(error(""), Contains("'speed'"));
    CHECK_THAT(error("speed = -1"), Contains("'speed' must be at least 0"));
    CHECK_THAT(error("speed = 1\npace = 0"), Contains("'pace'"));
}
