#include "catch.h"
#include "turtle/internode_bearers.h"
#include "turtle/stages/tree.h"

using namespace espalier;
using namespace espalier::geometry;
using namespace espalier::turtle;
using namespace espalier::test;
using Catch::Contains;

TEST_CASE("an internode stands on the last one before it on its branch", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).open().grow({1, 0, 0}).open().grow({1, 0, 1}).close().grow({1, 0, 0}).close();
    tree.open().open().close().grow({0, 0, 1}).close().grow({0, 1, 0});
    CHECK(internode_bearers(tree.geometry, tree.string) == std::vector<std::uint32_t>{no_bearer, 0, 1, 1, 0, 0});
}

TEST_CASE("plants may begin with branches, which stand on nothing", "[turtle][stages]") {
    Tree tree;
    tree.open().grow({0, 1, 0}).grow({0, 1, 0}).close().open().grow({1, 0, 0}).close().grow({0, 0, 1});
    CHECK(internode_bearers(tree.geometry, tree.string) ==
          std::vector<std::uint32_t>{no_bearer, 0, no_bearer, no_bearer});
}

TEST_CASE("internodes of one module's picture stand where they begin", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).grow({0, 1, 0}).grow_picture({0, 1, 0});
    Internode side = tree[1];
    side.base = tree[1].tip;
    side.tip = side.base + glm::dvec3(1, 0, 0);
    tree.geometry.internodes.push_back(side);
    CHECK(internode_bearers(tree.geometry, tree.string) == std::vector<std::uint32_t>{no_bearer, 0, 1, 1});
}

TEST_CASE("organs stand on the internode before them, or on the nearest that their module drew", "[turtle][stages]") {
    Tree tree;
    tree.bear().grow({0, 1, 0}).open().grow({1, 0, 0}).bear().close().bear();
    const OrganBearers bearers(tree.geometry, tree.string);
    std::vector<std::uint32_t> found;
    for (const Organ& organ : tree.geometry.organs) found.push_back(bearers.of(organ.module, organ.pose.position));
    CHECK(found == std::vector<std::uint32_t>{no_bearer, 1, 0});

    Tree picture;
    picture.grow({0, 1, 0}).grow_picture({0, 1, 0}).grow_picture({0, 1, 0});
    const OrganBearers own(picture.geometry, picture.string);
    CHECK(own.of(0, {0.5, 0.3, 0}) == 0);
    CHECK(own.of(0, {0.5, 1.7, 0}) == 1);
    CHECK(own.of(0, {0, 2, 0}) == 1);
    CHECK(own.of(0, {0, 9, 0}) == 2);
}

TEST_CASE("a stage that nobody knows is answered with the nearest name", "[turtle][stages]") {
    CHECK_THAT(refusal("stage = 'pipe-radi'"), Contains("stage.toml:1") && Contains("no geometry stage 'pipe-radi'") &&
                                                   Contains("did you mean 'pipe-radii'"));
    CHECK_THAT(refusal("lambda = 1"), Contains("'stage'"));
}

TEST_CASE("stages see what those before them left, and leave the box around it", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}, 0.25);
    Settings stem{{"stage", "stem"}, {"length", 2}};
    const GeometryStages twice{read_geometry_stage(stem), read_geometry_stage(stem)};
    StagedPlant plant{tree.geometry, tree.string, {}};
    apply(twice, plant);
    CHECK(tree.size() == 3);
    CHECK(tree.geometry.bounds.lower == glm::dvec3(-0.25, -0.25, -0.25));
    CHECK(tree.geometry.bounds.upper == glm::dvec3(0.25, 5.25, 0.25));
}
