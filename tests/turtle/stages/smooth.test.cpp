#include "catch.h"
#include "turtle/stages/tree.h"

#include <set>
#include <tuple>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

Tree smoothed(Tree tree, int pieces = 4) {
    return tree.stage({{"stage", "smooth"}, {"pieces", pieces}});
}

}  // namespace

TEST_CASE("nodes stay where they are, and every internode becomes its pieces", "[turtle][stages]") {
    const int pieces = GENERATE(2, 5, 16);
    Tree before = small_tree();
    for (std::size_t i = 0; i < before.size(); ++i) before.geometry.internodes[i].tip_radius = 0.02 * double(i + 1);
    const Tree after = smoothed(before, pieces);
    const auto n = std::size_t(pieces);
    REQUIRE(after.size() == n * before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[n * i].base == before[i].base);
        CHECK(after[n * i + n - 1].tip == before[i].tip);
        CHECK(after[n * i].base_radius == before[i].base_radius);
        CHECK(after[n * i + n - 1].tip_radius == before[i].tip_radius);
        for (std::size_t k = 0; k < n; ++k) {
            const Internode& piece = after[n * i + k];
            CHECK(piece.module == before[i].module);
            CHECK(piece.axis == before[i].axis);
            const double share = double(k + 1) / pieces;
            CHECK(piece.tip_radius ==
                  Approx(before[i].base_radius + share * (before[i].tip_radius - before[i].base_radius)));
            if (k > 0) CHECK(piece.base == after[n * i + k - 1].tip);
        }
    }
}

TEST_CASE("the curve has one tangent at each node of an axis", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).grow({1, 1, 0}).grow({0.1, 0, 0.1}).grow({0, 3, 1}).grow({1, 0, 0});
    // The angle between the pieces at a node falls with their length, so that it vanishes for a smooth curve.
    const auto bend = [&](int pieces, std::size_t node) {
        const Tree curve = smoothed(tree, pieces);
        const std::size_t at = node * std::size_t(pieces);
        const glm::dvec3 a = glm::normalize(curve[at - 1].tip - curve[at - 1].base);
        const glm::dvec3 b = glm::normalize(curve[at].tip - curve[at].base);
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    for (std::size_t node = 1; node < 5; ++node) {
        CHECK(bend(16, node) < 0.6 * bend(8, node));
        CHECK(bend(8, node) < 0.75 * bend(4, node));
    }
}

TEST_CASE("a straight axis stays straight, also where a short internode follows a long one", "[turtle][stages]") {
    Tree tree;
    const glm::dvec3 along = glm::normalize(glm::dvec3(1, 2, 0.5));
    tree.grow(10.0 * along).grow(0.01 * along).grow(3.0 * along).open().grow({1, 0, 0}).close();
    const Tree curve = smoothed(tree, 16);
    double reached = 0;
    for (std::size_t i = 0; i < 48; ++i) {
        CHECK(glm::length(glm::cross(curve[i].tip, along)) < 1e-12);
        CHECK(glm::dot(curve[i].tip, along) > reached);
        reached = glm::dot(curve[i].tip, along);
    }
}

TEST_CASE("branches leave where they did and curve on their own", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 1, 0}).open().grow({1, 0, 0}).close().grow({1, 1, 0});
    const Tree curve = smoothed(tree, 8);
    CHECK(curve[8].base == tree[0].tip);
    for (std::size_t i = 8; i < 16; ++i) CHECK(curve[i].tip.y == Approx(1));
    CHECK(curve[3].tip.x != 0);  // the trunk bends towards what follows
}

TEST_CASE("pieces keep the pictures of their internodes", "[turtle][stages]") {
    Tree tree = small_tree();
    tree.geometry.textures = {1, 0, 2};
    CHECK(smoothed(tree, 2).geometry.textures == std::vector<std::uint16_t>{1, 1, 0, 0, 2, 2});
}

TEST_CASE("axes of length 0 and axes with gaps are kept", "[turtle][stages]") {
    Tree tree;
    tree.grow({0, 0, 0}).grow({0, 1, 0}).grow({0, 0, 0}).grow({1, 0, 0});
    tree.geometry.internodes[3].base.x += 5;
    tree.geometry.internodes[3].tip.x += 5;
    const Tree curve = smoothed(tree, 3);
    for (std::size_t i = 0; i < curve.size(); ++i) {
        CHECK(std::isfinite(glm::length(curve[i].tip)));
        if (i >= 9) CHECK(curve[i].tip.y == Approx(1));
    }
}

TEST_CASE("smooth refuses numbers of pieces that are none", "[turtle][stages]") {
    CHECK_THAT(refusal("stage = 'smooth'\npieces = 1"), Contains("'pieces' must be between 2 and 16, not 1"));
    CHECK_THAT(refusal("stage = 'smooth'\npieces = 17"), Contains("'pieces' must be between 2 and 16, not 17"));
    CHECK_THAT(refusal("stage = 'smooth'\npieces = 2.5"), Contains("'pieces' must be a whole number"));
}
