#include "geometry/rays/ray_scene.h"

#include "catch.h"

#include <glm/geometric.hpp>

using namespace espalier;

namespace {

struct OneTriangle {
    std::vector<glm::vec3> corners{{0, 1, 0}, {1, 1, 0}, {0, 1, 1}};
    RayScene scene;
    OneTriangle() {
        const std::vector<RayScene::Part> parts{{corners, {{0, 0, 0}}}};
        scene.set_parts(parts);
    }
};

}  // namespace

TEST_CASE("the weights of a hit give back the point where the ray meets the triangle", "[rays]") {
    const OneTriangle one;
    const auto hit = one.scene.first_hit({0.3f, 0, 0.2f}, {0, 1, 0}, 0, 2);
    REQUIRE(hit);
    const glm::vec3 point = (1 - hit->u - hit->v) * one.corners[0] + hit->u * one.corners[1] + hit->v * one.corners[2];
    CHECK(glm::distance(point, glm::vec3(0.3f, 1, 0.2f)) < 1e-6f);
}

TEST_CASE("a ray is blocked by what lies between its ends, and by nothing else", "[rays]") {
    const OneTriangle one;
    CHECK(one.scene.is_blocked({0.3f, 0, 0.2f}, {0, 1, 0}, 0, 2));
    CHECK_FALSE(one.scene.is_blocked({0.3f, 0, 0.2f}, {0, 1, 0}, 0, 0.9f));
    CHECK_FALSE(one.scene.is_blocked({0.3f, 0, 0.2f}, {0, 1, 0}, 1.1f, 2));
    CHECK_FALSE(one.scene.is_blocked({0.7f, 0, 0.7f}, {0, 1, 0}, 0, 2));
    CHECK_FALSE(RayScene().is_blocked({0, 0, 0}, {0, 1, 0}, 0, 2));
}
