#include "catch.h"
#include "turtle/stages/tree.h"

#include <cmath>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

Tree piped(Settings parameters, Tree tree = small_tree()) {
    parameters.put("stage", "pipe-radii");
    return tree.stage(parameters);
}

/// r^n summed over the internodes that begin at a node.
double borne_by(const Tree& tree, std::size_t internode, double exponent) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (tree[i].base == tree[internode].tip) sum += std::pow(tree[i].tip_radius, exponent);
    }
    return sum;
}

}  // namespace

TEST_CASE("at every fork r^n is the sum over what is borne", "[turtle][stages]") {
    const double exponent = GENERATE(2.0, 2.5, 3.0), factor = GENERATE(1.0, 1.7);
    const Tree tree = piped({{"exponent", exponent}, {"tip", 0.01}, {"factor", factor}});
    int forks = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const double borne = borne_by(tree, i, exponent);
        if (borne == 0) {
            CHECK(tree[i].tip_radius == Approx(0.01 * factor));
        } else {
            ++forks;
            CHECK(std::pow(tree[i].tip_radius, exponent) == Approx(borne).epsilon(1e-12));
        }
    }
    CHECK(forks == 3);
}

TEST_CASE("what bears k tips is k^(1/n) times as thick as they are", "[turtle][stages]") {
    const double exponent = GENERATE(2.0, 2.5, 3.0);
    Tree tree;
    tree.grow({0, 1, 0});
    for (int tip = 0; tip < 7; ++tip) tree.open().grow({1, tip, 0}).grow({1, tip, 0}).close();
    tree.stage({{"stage", "pipe-radii"}, {"exponent", exponent}, {"tip", 0.02}});
    CHECK(tree[0].tip_radius == Approx(0.02 * std::pow(7, 1 / exponent)).epsilon(1e-12));
}

TEST_CASE("an unbranched chain keeps its radius", "[turtle][stages]") {
    Tree tree;
    for (int i = 0; i < 1000; ++i) tree.grow({0, 1, 0});
    tree.stage({{"stage", "pipe-radii"}, {"tip", 0.02}});
    for (std::size_t i = 0; i < tree.size(); ++i) {
        REQUIRE(tree[i].base_radius == 0.02);
        REQUIRE(tree[i].tip_radius == 0.02);
    }
}

TEST_CASE("a factor scales all radii", "[turtle][stages]") {
    const Tree thin = piped({}), thick = piped({{"factor", 3}});
    for (std::size_t i = 0; i < thin.size(); ++i) {
        CHECK(thick[i].tip_radius == Approx(3 * thin[i].tip_radius));
        CHECK(thick[i].base_radius == Approx(3 * thin[i].base_radius));
    }
}

TEST_CASE("a branch much thinner than its bearer begins with its own radius", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).open().grow({1, 0, 0}).close().grow({0, 1, 0});
    for (int twig = 0; twig < 30; ++twig) tree.open().grow({1, twig, 0}).close();
    const double join = GENERATE(0.0, 0.25, 0.5, 1.0);
    tree = piped({{"join", join}, {"exponent", 2}, {"tip", 1}}, tree);
    const Internode &trunk = tree[0], &twig = tree[1], &leader = tree[2];
    CHECK(twig.tip_radius == 1);
    CHECK(trunk.tip_radius == Approx(std::sqrt(31)));
    CHECK(twig.base_radius == (join * std::sqrt(31) > 1 ? 1 : trunk.tip_radius));
    CHECK(leader.base_radius == (join == 1 ? leader.tip_radius : trunk.tip_radius));
    for (std::size_t i = 1; i < tree.size(); ++i) {
        INFO("no cone is steeper than the threshold");
        if (join > 0) CHECK(tree[i].base_radius * join <= tree[i].tip_radius * (1 + 1e-12));
    }
}

TEST_CASE("an axis that goes on much thinner than before goes on as another", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).grow({0, 1, 0}).open();
    for (int lateral = 0; lateral < 9; ++lateral) tree.grow({1, 0, 0}).open().grow({0, 0, 1}).close();
    tree.grow({1, 0, 0}).close().grow({0, 1, 0}).grow({0, 1, 0});
    const std::size_t last = tree.size() - 1;
    tree = piped({{"exponent", 2}, {"tip", 1}}, tree);
    CHECK(tree[1].axis == 0);
    CHECK(tree[2].base_radius == tree[1].tip_radius);
    CHECK(tree[2].axis == 1);
    CHECK(tree[last - 1].axis == 11);
    CHECK(tree[last].axis == 11);
    CHECK(tree[last - 1].base_radius == 1);
    CHECK(tree.geometry.axes == 12);
    CHECK(piped({{"exponent", 2}, {"tip", 1}, {"join", 0}}, small_tree()).geometry.axes == small_tree().geometry.axes);
}

TEST_CASE("a leader is thicker than all that reaches its height, and no thinner than the pipe model has it",
          "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).open().grow({1, 1, 0});
    for (int tip = 0; tip < 9; ++tip) tree.open().grow({1, 3, 0.1 * tip}).close();
    tree.close().grow({0, 1, 0}).grow({0, 1, 0}).grow({0, 3, 0});
    const Tree plain = piped({}, tree), led = piped({{"leader", 1.2}}, tree);
    bool was_thinner = false;
    for (std::size_t i = 0; i < led.size(); ++i) {
        CHECK(led[i].tip_radius >= plain[i].tip_radius);
        if (led[i].order != 0) CHECK(led[i].tip_radius == plain[i].tip_radius);
        for (std::size_t k = 0; led[i].order == 0 && k < led.size(); ++k) {
            if (led[k].order == 0 || led[k].tip.y <= led[i].base.y) continue;
            CHECK(led[i].tip_radius >= Approx(1.2 * led[k].tip_radius));
            was_thinner = was_thinner || plain[i].tip_radius < plain[k].tip_radius;
        }
    }
    CHECK(was_thinner);
}

TEST_CASE("radii by the pipe model replace widths in pixels", "[turtle][stages]") {
    Tree tree = small_tree();
    tree.geometry.in_pixels = true;
    for (Internode& internode : tree.geometry.internodes) internode.pixels = 3;
    tree.stage({{"stage", "pipe-radii"}});
    CHECK_FALSE(tree.geometry.in_pixels);
    for (std::size_t i = 0; i < tree.size(); ++i) CHECK(tree[i].pixels == 0);
}

TEST_CASE("pipe-radii refuses what is no exponent, radius or share", "[turtle][stages]") {
    const auto error = [](const std::string& line) { return refusal("stage = 'pipe-radii'\n" + line); };
    CHECK_THAT(error("exponent = nan"), Contains("'exponent' must be a finite number"));
    CHECK_THAT(error("exponent = 0.4"), Contains("'exponent' must be between 0.5 and 10, not 0.4"));
    CHECK_THAT(error("tip = 0"), Contains("'tip' must be greater than 0"));
    CHECK_THAT(error("factor = -1"), Contains("'factor' must be greater than 0"));
    CHECK_THAT(error("join = 1.1"), Contains("'join' must be between 0 and 1"));
    CHECK_THAT(error("exponnt = 2"), Contains("stage.toml:2") && Contains("did you mean 'exponent'"));
}
