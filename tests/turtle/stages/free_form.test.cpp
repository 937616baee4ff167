#include "catch.h"
#include "turtle/stages/tree.h"

#include <fmt/format.h>

using namespace espalier;
using namespace espalier::test;
using Catch::Contains;

namespace {

/// The box from -4 to 4, its points moved by a function of where they are.
template <class Move>
Settings box(const std::string& lattice, int x, int y, int z, Move move, const std::string& more = "") {
    std::string moves;
    for (int k = 0; k < z; ++k) {
        for (int j = 0; j < y; ++j) {
            for (int i = 0; i < x; ++i) {
                const auto place = [](int at, int count) { return -4 + 8.0 * at / (count - 1); };
                const glm::dvec3 by = move(glm::dvec3(place(i, x), place(j, y), place(k, z)));
                moves += fmt::format("[{}, {}, {}],", by.x, by.y, by.z);
            }
        }
    }
    return Settings::parse_toml(fmt::format("stage = 'free-form'\nlower = [-4, -4, -4]\nupper = [4, 4, 4]\n"
                                            "lattice = {}\nmoves = [{}]\n{}\n",
                                            lattice, moves, more),
                                "scene.toml");
}

glm::dvec3 affine(const glm::dvec3& at) {
    return {0.2 * at.y + 1, 0.1 * at.x - 0.3 * at.z, 0.05 * at.y};
}

}  // namespace

TEST_CASE("a lattice whose points stay changes nothing", "[turtle][stages]") {
    const Tree before = small_tree();
    Tree after = before;
    after.stage(box("[3, 2, 4]", 3, 2, 4, [](const glm::dvec3&) { return glm::dvec3(0); }));
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(glm::distance(before[i].tip, after[i].tip) < 1e-12);
}

TEST_CASE("a lattice that moves by an affine map moves the plant by that map", "[turtle][stages]") {
    const Tree before = small_tree();
    Tree after = before;
    after.stage(box("[3, 4, 2]", 3, 4, 2, affine, "leaves = 'bent'"));
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(glm::distance(before[i].tip + affine(before[i].tip), after[i].tip) < 1e-12);
        CHECK(glm::distance(before[i].base + affine(before[i].base), after[i].base) < 1e-12);
    }
    const auto &old = before.geometry.vertices, &bent = after.geometry.vertices;
    for (std::size_t i = 0; i < old.size(); ++i) CHECK(glm::distance(old[i] + affine(old[i]), bent[i]) < 1e-12);
}

TEST_CASE("leaves are left where they are, or carried without a change of shape", "[turtle][stages]") {
    const Tree before = small_tree();
    Tree left = before, carried = before;
    left.stage(box("[2, 2, 2]", 2, 2, 2, affine, "leaves = 'left'"));
    carried.stage(box("[2, 2, 2]", 2, 2, 2, affine));
    CHECK(left.geometry.vertices == before.geometry.vertices);
    CHECK(left.geometry.organs[0].pose.position == before.geometry.organs[0].pose.position);
    CHECK(left[2].tip != before[2].tip);
    const auto &old = before.geometry.vertices, &now = carried.geometry.vertices;
    CHECK(glm::distance(now[0], old[0] + affine(old[0])) < 1e-12);
    for (std::size_t i = 1; i < 3; ++i) CHECK(glm::distance(now[i] - now[0], old[i] - old[0]) < 1e-12);
}

TEST_CASE("a lattice of another size than its moves is refused", "[turtle][stages]") {
    Tree tree = small_tree();
    const auto none = [](const glm::dvec3&) { return glm::dvec3(0); };
    CHECK_THROWS_WITH(tree.stage(box("[3, 2, 2]", 2, 2, 2, none)),
                      Contains("'moves' must have a vector for each of the 12 points of the lattice, not 8"));
    CHECK_THROWS_WITH(tree.stage(box("[1, 2, 2]", 2, 2, 2, none)),
                      Contains("'lattice' must be three whole numbers from 2 to 16"));
}
