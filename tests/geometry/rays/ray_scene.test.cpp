#include "geometry/rays/ray_scene.h"

#include "espalier/base/random.h"
#include "espalier/base/stations.h"

#include "catch.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

using namespace espalier;

namespace {

struct OneTriangle {
    std::vector<glm::vec3> corners{{0, 1, 0}, {1, 1, 0}, {0, 1, 1}};
    RayScene scene;
    OneTriangle() {
        const std::vector<RayScene::Part> parts{{corners, {moved_by({0, 0, 0})}}};
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

TEST_CASE("which of two coincident triangles a ray meets does not depend on the threads that build", "[rays]") {
    RandomSamples samples(RandomKey(5, 0, Stream::process, 1), 3, 0);
    const auto place = [&] { return glm::vec3(samples.uniform(), samples.uniform(), samples.uniform()); };
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8000; ++i) {
        const glm::vec3 corner = place();
        for (const glm::vec3& shift : {glm::vec3(0), glm::vec3(0.03f, 0, 0), glm::vec3(0, 0.01f, 0.03f)}) {
            corners.push_back(corner + shift);
        }
    }
    const std::vector<glm::vec3> once = corners;
    for (std::size_t i = 0; i < once.size(); ++i) {
        const std::size_t triangle = (i / 3 * 7919 + 100) % (once.size() / 3);
        corners.push_back(once[3 * triangle + i % 3]);
    }
    const auto hits_of = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        RayScene scene;
        const std::vector<RayScene::Part> parts{{corners, {moved_by({0, 0, 0})}}};
        scene.set_parts(parts);
        RandomSamples own(RandomKey(6, 0, Stream::process, 1), 3, 0);
        std::vector<std::uint32_t> hits;
        for (int i = 0; i < 20000; ++i) {
            const glm::vec3 origin(own.uniform(), 2, own.uniform()), direction(own.uniform() - 0.5, -1, 0);
            const auto hit = scene.first_hit(origin, direction, 0, 10);
            hits.push_back(hit ? hit->triangle : 0xFFFFFFFF);
        }
        return hits;
    };
    CHECK(hits_of(1) == hits_of(4));
}

TEST_CASE("a part that stands alone is hit to the last bit as one beside others", "[rays]") {
    RandomSamples samples(RandomKey(7, 0, Stream::process, 1), 3, 0);
    const auto place = [&] { return glm::vec3(samples.uniform(), samples.uniform(), samples.uniform()); };
    std::vector<glm::vec3> corners, far_away{{900, 0, 0}, {901, 0, 0}, {900, 1, 0}};
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 middle = 3.0F * place();
        for (int k = 0; k < 3; ++k) corners.push_back(middle + 0.2F * place());
    }
    RayScene alone, beside;
    const std::vector<RayScene::Part> one{{corners, {moved_by({0, 0, 0})}}},
        two{{corners, {moved_by({0, 0, 0})}}, {far_away, {moved_by({0, 0, 0})}}};
    alone.set_parts(one);
    beside.set_parts(two);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 origin = 3.0F * place(), direction = glm::normalize(place() - 0.5F);
        const auto a = alone.first_hit(origin, direction, 1e-5F, 50),
                   b = beside.first_hit(origin, direction, 1e-5F, 50);
        REQUIRE(a.has_value() == b.has_value());
        REQUIRE(alone.is_blocked(origin, direction, 1e-5F, 50) == a.has_value());
        if (!a) continue;
        REQUIRE(a->triangle == b->triangle);
        REQUIRE(a->distance == b->distance);
        REQUIRE(a->u == b->u);
        ++hits;
    }
    CHECK(hits > 5000);
}

TEST_CASE("four rays together meet what each meets alone", "[rays]") {
    std::vector<glm::vec3> corners;
    RandomSamples samples(RandomKey(77, 0, Stream::process), 0, 0);
    const auto number = [&] { return static_cast<float>(2 * samples.uniform() - 1); };
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 middle(number(), number(), number());
        for (int k = 0; k < 3; ++k) corners.push_back(middle + 0.1F * glm::vec3(number(), number(), number()));
    }
    geometry::RayScene scene;
    const std::array parts{geometry::RayScene::Part{corners, {geometry::moved_by(glm::vec3(0))}}};
    scene.set_parts(parts);
    int met = 0;
    for (int turn = 0; turn < 500; ++turn) {
        std::array<glm::vec3, 4> origins, directions;
        const glm::vec3 eye(3, number(), number());
        for (std::size_t k = 0; k < 4; ++k) {
            origins[k] = eye;
            directions[k] = glm::normalize(glm::vec3(-1, 0.3F * number(), 0.3F * number()));
        }
        const auto together = scene.first_hits(origins, directions, 10);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto alone = scene.first_hit(origins[k], directions[k], 0, 10);
            REQUIRE(together[k].has_value() == alone.has_value());
            if (!alone) continue;
            ++met;
            REQUIRE(together[k]->triangle == alone->triangle);
            REQUIRE(together[k]->part == 0);
            REQUIRE(together[k]->distance == Approx(alone->distance));
        }
    }
    CHECK(met > 200);
}
