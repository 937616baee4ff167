#include "catch.h"
#include "turtle/drawing.h"

#include <functional>

using namespace espalier;

namespace {

/// A lattice of 2 x 3 x 2 points in the box from -3 to 3, which moves by a function of where the points are.
std::string lattice(int leaves, const std::function<glm::dvec3(const glm::dvec3&)>& move) {
    std::string text = "@Db(" + std::to_string(leaves) + ",2,3,2,-3,-3,-3,3,3,3";
    for (const double z : {-3.0, 3.0}) {
        for (const double y : {-3.0, 0.0, 3.0}) {
            for (const double x : {-3.0, 3.0}) {
                const glm::dvec3 by = move({x, y, z});
                for (int axis = 0; axis < 3; ++axis) text.append(",").append(std::to_string(by[axis]));
            }
        }
    }
    return text + ")";
}

glm::dvec3 affine(const glm::dvec3& at) {
    return {0.25 * at.y + 1, 0.5 * at.x - 0.25 * at.z, 0.5 * at.y};
}

const std::string branch = "F(1)+(40)F(1)[&(30){.f(1).-(90)f(0.5).}]F(0.5)@O(0.1)";

}  // namespace

TEST_CASE("a deformation whose lattice stays changes nothing", "[turtle]") {
    const auto stay = [](const glm::dvec3&) { return glm::dvec3(0); };
    Drawing plain(branch), bent(lattice(0, stay) + branch + "@De");
    for (std::size_t k = 0; k < plain.geometry().internodes.size(); ++k) {
        CHECK(glm::distance(plain.geometry().internodes[k].tip, bent.geometry().internodes[k].tip) < 1e-12);
    }
    CHECK(plain.geometry().vertices == bent.geometry().vertices);
}

TEST_CASE("a deformation by an affine map moves what is drawn until it ends by that map, and nothing else",
          "[turtle]") {
    Drawing plain("F(1)" + branch), bent("F(1)" + lattice(0, affine) + branch + "@De F(2)");
    const auto &before = plain.geometry(), &after = bent.geometry();
    const glm::dvec3 origin(0, 1, 0);  // the box stands where the turtle is
    CHECK(before.internodes[0].tip == after.internodes[0].tip);
    for (std::size_t k = 1; k < before.internodes.size(); ++k) {
        const glm::dvec3& tip = before.internodes[k].tip;
        CHECK(glm::distance(tip + affine(tip - origin), after.internodes[k].tip) < 1e-12);
    }
    for (std::size_t k = 0; k < before.vertices.size(); ++k) {
        const glm::dvec3& vertex = before.vertices[k];
        CHECK(glm::distance(vertex + affine(vertex - origin), after.vertices[k]) < 1e-12);
    }
    // The turtle goes on where it would be without.
    CHECK(glm::distance(after.internodes.back().base, before.internodes.back().tip) < 1e-12);
}

TEST_CASE("leaves of a deformation bend, are carried, or stay", "[turtle]") {
    Drawing plain(branch), carried(lattice(1, affine) + branch + "@De"), left(lattice(2, affine) + branch + "@De");
    const auto &before = plain.geometry().vertices, &moved = carried.geometry().vertices;
    CHECK(left.geometry().vertices == before);
    CHECK(left.geometry().organs[0].pose.position == plain.geometry().organs[0].pose.position);
    CHECK(left.geometry().internodes[1].tip != plain.geometry().internodes[1].tip);
    CHECK(glm::distance(moved[0], before[0] + affine(before[0])) < 1e-12);
    for (std::size_t k = 1; k < before.size(); ++k) {
        CHECK(glm::distance(moved[k] - moved[0], before[k] - before[0]) < 1e-12);
    }
}

TEST_CASE("a deformation that is not ended reaches to the end of the string; its bounds are those of what it moved",
          "[turtle]") {
    const auto aside = [](const glm::dvec3&) { return glm::dvec3(10, 0, 0); };
    Drawing drawing(lattice(0, aside) + "F(1)");
    CHECK(glm::distance(drawing.geometry().internodes[0].tip, glm::dvec3(10, 1, 0)) < 1e-12);
    CHECK(drawing.geometry().bounds.lower.x > 9);
}

TEST_CASE("a deformation says what is wrong with its numbers", "[turtle]") {
    CHECK_THROWS_WITH(Drawing("@Db(0,2,2,2,-1,-1,-1,1,1,1)").draw(),
                      Catch::Contains("needs a vector for each point of its lattice"));
    CHECK_THROWS_WITH(Drawing("@Db(0,1,2,2,-1,-1,-1,1,1,1)").draw(), Catch::Contains("2 to 16 points"));
    CHECK_THROWS_WITH(Drawing("@Db(0,2,2,2,1,1,1,1,1,1)").draw(), Catch::Contains("lies not above"));
}
