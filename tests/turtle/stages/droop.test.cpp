#include "catch.h"
#include "turtle/stages/tree.h"

#include <cmath>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

TEST_CASE("a branch at theta from down turns by lambda (1 - theta/180) theta", "[turtle][stages]") {
    const auto [theta, psi] =
        GENERATE(table<double, double>({{180, 0}, {120, 32}, {90, 36}, {45, 27}, {1, 0.8 * 179 / 180.0}, {0, 0}}));
    Tree tree;
    tree.grow({0, 1, 0}).open().grow(from_down(theta)).close();
    tree.stage({{"stage", "droop"}, {"lambda", 0.8}});
    CHECK(tree.from_down(0) == Approx(180));
    CHECK(tree.from_down(1) == Approx(theta - psi).margin(1e-9));
    CHECK(tree[1].base == tree[0].tip);
}

TEST_CASE("no angle turns by more than 45 lambda, which 90 degrees do", "[turtle][stages]") {
    for (double theta = 0; theta <= 180; theta += 1) {
        Tree tree;
        tree.grow(from_down(theta)).stage({{"stage", "droop"}, {"lambda", 1}, {"from", 0}});
        CHECK(theta - tree.from_down(0) <= 45 + 1e-9);
        CHECK(theta - tree.from_down(0) >= -1e-9);
    }
}

TEST_CASE("an internode is measured after its bearer has turned", "[turtle][stages]") {
    const auto turned = [](double theta) { return theta - 0.8 * (1 - theta / 180) * theta; };
    Tree tree;
    tree.grow({0, 1, 0}).open().grow(from_down(120)).grow(from_down(140)).grow(from_down(90)).close();
    tree.stage({{"stage", "droop"}, {"lambda", 0.8}});
    const double first = turned(120), second = turned(140 - 32), third = turned(90 - 32 - (140 - 32 - second));
    CHECK(tree.from_down(1) == Approx(first));
    CHECK(tree.from_down(2) == Approx(second));
    CHECK(tree.from_down(3) == Approx(third));
}

TEST_CASE("without strength nothing hangs, to the last bit", "[turtle][stages]") {
    CHECK(same(small_tree().stage({{"stage", "droop"}, {"lambda", 0}}), small_tree()));
}

TEST_CASE("lengths stay, and branches stay on what bears them", "[turtle][stages]") {
    const Tree before = small_tree();
    const Tree after = small_tree().stage({{"stage", "droop"}, {"lambda", 0.9}, {"from", 0}});
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after.length(i) == Approx(before.length(i)).epsilon(1e-12));
    for (std::size_t i = 0; i < before.size(); ++i) {
        for (std::size_t k = 0; k < before.size(); ++k) {
            CHECK((after[i].tip == after[k].base) == (before[i].tip == before[k].base));
        }
    }
}

TEST_CASE("branches hang from an order on, or from a number of internodes on", "[turtle][stages]") {
    const Tree before = small_tree();
    const auto turned = [&](Settings parameters) {
        parameters.put("stage", "droop");
        parameters.put("lambda", 0.5);
        const Tree after = small_tree().stage(parameters);
        std::vector<bool> turns;
        for (std::size_t i = 0; i < before.size(); ++i) {
            turns.push_back(glm::distance(after[i].tip - after[i].base, before[i].tip - before[i].base) > 1e-9);
        }
        return turns;
    };
    // The orders are 0 1 2 1 0 1 0, the depths 1 2 3 3 2 3 3; internodes 0 and 6 point straight up.
    CHECK(turned({}) == std::vector<bool>{false, true, true, true, false, true, false});
    CHECK(turned({{"from", 2}}) == std::vector<bool>{false, false, true, false, false, false, false});
    CHECK(turned({{"from", 3}}) == std::vector<bool>(7, false));
    CHECK(turned({{"from", 3}, {"count", "nodes"}}) == std::vector<bool>{false, false, true, true, false, true, false});
    CHECK(turned({{"from", 2}, {"count", "nodes"}}) == std::vector<bool>{false, true, true, true, true, true, true});
}

TEST_CASE("what an internode bears turns with it", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).bear().open().grow({1, 0, 0}).bear().close();
    tree.stage({{"stage", "droop"}, {"lambda", 1}});
    const double half = std::sqrt(0.5);  // 45 degrees down
    const glm::dvec3 tip(half, 1 - half, 0), x(half, -half, 0), y(half, half, 0);
    const auto close = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-12; };
    const PlantGeometry& geometry = tree.geometry;

    const Pose &still = geometry.organs[0].pose, &pose = geometry.organs[1].pose;
    CHECK(still.position == glm::dvec3(0, 1, 0));
    CHECK(still.heading == glm::dvec3(0, 1, 0));
    CHECK(close(tree[1].tip, tip));
    CHECK(pose.position == tree[1].tip);
    CHECK(close(pose.heading, y));
    CHECK(close(pose.left, -x));
    CHECK(close(pose.up, {0, 0, -1}));

    CHECK(geometry.vertices[1] == glm::dvec3(1, 1, 0));
    CHECK(geometry.mesh.vertices[1].position == glm::dvec3(1, 1, 0));
    CHECK(geometry.labels[0].position == glm::dvec3(0, 1, 0));
    CHECK(close(geometry.vertices[4], tip + x));
    CHECK(close(geometry.vertices[5], tip + y));
    CHECK(close(geometry.mesh.vertices[4].position, tip + x));
    CHECK(close(geometry.mesh.vertices[4].normal, {0, 0, 1}));
    CHECK(close(geometry.labels[1].position, tip));
}

TEST_CASE("a long branch hangs without losing its length", "[turtle][stages]") {
    Tree tree;
    for (int i = 0; i < 5000; ++i) tree.grow({1, 0.01, 0.02});
    const double length = tree.length(0);
    tree.stage({{"stage", "droop"}, {"lambda", 0.01}, {"from", 0}});
    for (std::size_t i = 0; i < tree.size(); i += 499) CHECK(tree.length(i) == Approx(length).epsilon(1e-9));
    CHECK(tree.from_down(4999) < 1);
}

TEST_CASE("droop refuses strengths and orders that are none", "[turtle][stages]") {
    const auto error = [](const std::string& line) { return refusal("stage = 'droop'\n" + line); };
    CHECK_THAT(error(""), Contains("'lambda'"));
    CHECK_THAT(error("lambda = nan"), Contains("'lambda' must be a finite number"));
    CHECK_THAT(error("lambda = 1.5"), Contains("'lambda' must be between 0 and 1, not 1.5"));
    CHECK_THAT(error("lambda = 1\nfrom = -1"), Contains("'from' must be between 0 and 65535"));
    CHECK_THAT(error("lambda = 1\ncount = 'node'"), Contains("did you mean 'nodes'"));
}
