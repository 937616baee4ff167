#include "catch.h"
#include "turtle/stages/tree.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

/// A stem of 2 m that is 0.2 m thick, with two branches.
Tree stem() {
    Tree tree;
    tree.grow({0, 2, 0}, 0.1).open().grow({1, 1, 0}, 0.02).close().grow({0, 1, 0}, 0.03);
    return tree;
}

Tree flared(Settings parameters) {
    parameters.put("stage", "root-flare");
    return stem().stage(parameters);
}

}  // namespace

TEST_CASE("roots lie below the ground, each on its side, and end thin", "[turtle][stages]") {
    const Tree tree = flared({{"roots", 5}});
    glm::dvec3 sum(0);
    std::size_t nodes = 0, backs = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (tree[i].axis < 3 && tree[i].tip.y > 0) continue;
        ++nodes;
        CHECK(tree[i].tip.y < 0);
        CHECK(tree[i].tip.y < tree[i].base.y);
        CHECK(tree[i].tip_radius < tree[i].base_radius);
        backs += tree[i].tip.y + tree[i].tip_radius > 0;
        sum += glm::normalize(glm::dvec3(tree[i].tip.x, 0, tree[i].tip.z));
    }
    CHECK(nodes == 50);
    CHECK(backs >= 5);  // near the stem they are seen
    CHECK(backs < 40);  // and then they are gone
    CHECK(glm::length(sum) < 0.3 * double(nodes));
}

TEST_CASE("the foot of the stem is so many times as wide, and its length stays", "[turtle][stages]") {
    const Tree before = stem(), after = flared({{"roots", 3}, {"flare", 2}});
    CHECK(after[0].base == before[0].base);
    CHECK(after[0].base_radius == Approx(2 * before[0].base_radius));
    CHECK(after[4].tip == before[0].tip);
    CHECK(after[4].tip_radius == before[0].tip_radius);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(after[i].tip == after[i + 1].base);
        CHECK(after[i].tip_radius == after[i + 1].base_radius);
        CHECK(after[i].tip_radius < after[i].base_radius);
    }
}

TEST_CASE("no roots change nothing, nor does a plant without a stem or without radius", "[turtle][stages]") {
    CHECK(same(flared({{"roots", 0}}), stem()));
    Tree bare;
    CHECK(bare.bear().stage({{"stage", "root-flare"}, {"roots", 4}}).size() == 0);
    Tree line;
    CHECK(line.grow({0, 1, 0}, 0).stage({{"stage", "root-flare"}, {"roots", 4}}).size() == 1);
}

TEST_CASE("root-flare refuses what is no number of roots, length or width", "[turtle][stages]") {
    CHECK_THROWS_WITH(flared({}), Contains("roots"));
    CHECK_THROWS_WITH(flared({{"roots", -1}}), Contains("roots"));
    CHECK_THROWS_WITH(flared({{"roots", 1}, {"length", 0}}), Contains("length"));
    CHECK_THROWS_WITH(flared({{"roots", 1}, {"flare", 0.5}}), Contains("flare"));
}
