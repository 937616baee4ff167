#include "catch.h"
#include "turtle/internode_bearers.h"
#include "turtle/stages/tree.h"

#include <cmath>

using namespace espalier;
using namespace espalier::geometry;
using namespace espalier::turtle;
using namespace espalier::test;
using Catch::Contains;

TEST_CASE("a stem lifts everything by one vector, exactly", "[turtle][stages]") {
    const Tree before = small_tree();
    const Tree after = small_tree().stage({{"stage", "stem"}, {"length", 2.5}});
    const glm::dvec3 up(0, 2.5, 0);
    REQUIRE(after.size() == before.size() + 1);
    CHECK(after[0].base == before[0].base);
    CHECK(after[0].tip == before[0].base + up);
    CHECK(after.length(0) == 2.5);
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i + 1].base == before[i].base + up);
        CHECK(after[i + 1].tip == before[i].tip + up);
    }
    CHECK(after.geometry.organs[0].pose.position == before.geometry.organs[0].pose.position + up);
    CHECK(after.geometry.vertices[1] == before.geometry.vertices[1] + up);
    CHECK(after.geometry.mesh.vertices[1].position == before.geometry.mesh.vertices[1].position + up);
    CHECK(after.geometry.labels[0].position == before.geometry.labels[0].position + up);
}

TEST_CASE("a stem of no length is none", "[turtle][stages]") {
    CHECK(same(small_tree().stage({{"stage", "stem"}, {"length", 0}}), small_tree()));
    Tree bare;
    CHECK(bare.bear().stage({{"stage", "stem"}, {"length", 2}}).size() == 0);
}

TEST_CASE("a stem goes where the plant began to go, or where it is told", "[turtle][stages]") {
    Tree leaning;
    leaning.grow({3, 4, 0});
    CHECK(Tree(leaning).stage({{"stage", "stem"}, {"length", 10}})[1].base == glm::dvec3(0, 10, 0));
    Tree aslant = leaning;
    Settings stem{{"stage", "stem"}, {"length", 10}};
    StagedPlant plant{aslant.geometry, aslant.string, {}, {0.6, 0.8, 0}};
    apply({read_geometry_stage(stem)}, plant);
    CHECK(aslant[1].base == glm::dvec3(6, 8, 0));
    const Tree told =
        Tree(leaning).stage({{"stage", "stem"}, {"length", 10}, {"direction", glm::dvec3(0, 0, -2)}, {"pieces", 4}});
    REQUIRE(told.size() == 5);
    CHECK(told[4].base == glm::dvec3(0, 0, -10));
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(told.length(i) == 2.5);
        CHECK(told[i].tip == told[i + 1].base);
        CHECK(told[i].axis == 0);
    }
}

TEST_CASE("a stem is as thick as its crown asks for", "[turtle][stages]") {
    Tree tree = small_tree();
    tree.stage({{"stage", "stem"}, {"length", 1}, {"pieces", 3}}).stage({{"stage", "pipe-radii"}, {"exponent", 2}});
    for (std::size_t i = 0; i < 4; ++i) CHECK(tree[i].tip_radius == Approx(0.005 * std::sqrt(4)));
}

TEST_CASE("a plant that begins with branches stands on its stem with all of them", "[turtle][stages]") {
    Tree tree;
    tree.open().grow({1, 1, 0}).close().open().grow({-1, 1, 0}).close().grow({0, 1, 0});
    tree.geometry.textures = {5};
    tree.stage({{"stage", "stem"}, {"length", 1}, {"direction", glm::dvec3(0, 1, 0)}});
    CHECK(internode_bearers(tree.geometry, tree.string) == std::vector<std::uint32_t>{no_bearer, 0, 0, 0});
    CHECK(tree[0].order == 0);
    for (std::size_t i = 0; i < 4; ++i) CHECK(tree[i].axis == i);
    CHECK(tree.geometry.axes == 4);
    CHECK(tree.geometry.textures == std::vector<std::uint16_t>{5, 5});
}

TEST_CASE("stem refuses lengths and directions that are none", "[turtle][stages]") {
    const auto error = [](const std::string& line) { return refusal("stage = 'stem'\n" + line); };
    CHECK_THAT(error(""), Contains("'length'"));
    CHECK_THAT(error("length = -1"), Contains("'length' must be at least 0"));
    CHECK_THAT(error("length = inf"), Contains("'length' must be a finite number"));
    CHECK_THAT(error("length = 1\npieces = 0"), Contains("'pieces' must be between 1 and 1000"));
    CHECK_THAT(error("length = 1\ndirection = [0, 0, 0]"), Contains("'direction' of a stem"));
}
