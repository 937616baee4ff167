// Shoots that turn to the light, and shoots that cannot see it or find it on all sides.
#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace espalier;

namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

/// The direction of the five youngest parts of the stem.
glm::dvec3 heading(std::uint64_t seed, const Overrides& overrides) {
    SceneOptions options;
    options.overrides = overrides;
    options.overrides.emplace_back("simulation.seed", std::to_string(seed));
    const auto world = grown("environments/phototropism.toml", options);
    const auto& stem = world->interpretation(0).geometry.internodes;
    return glm::normalize(stem.back().tip - stem[stem.size() - 5].base);
}

Overrides sun_at(const glm::dvec3& sun) {
    return {{"environment.light.sky.sun",
             "[" + std::to_string(sun.x) + ", " + std::to_string(sun.y) + ", " + std::to_string(sun.z) + "]"}};
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("a shoot ends in the direction of the light; under a sky alone, or with a cap, it stays upright",
          "[phototropism]") {
    const glm::dvec3 up(0, 1, 0);
    std::uint64_t seed = 11;
    for (const glm::dvec3& sun : {glm::dvec3(1, 1, 0), glm::dvec3(-0.3, 1, 0.6), glm::dvec3(0.5, 0.3, -1)}) {
        const double apart = degrees_between(heading(++seed, sun_at(sun)), sun);
        UNSCOPED_INFO("light " << degrees_between(sun, up) << " degrees from upright: " << apart << " from it");
        CHECK(apart < 10);
    }
    const double alone = degrees_between(heading(21, {{"environment.light.sky.diffuse", "1"}}), up);
    UNSCOPED_INFO("sky alone: " << alone << " degrees from upright");
    CHECK(alone < 8);
    CHECK(degrees_between(heading(22, {{"plant.0.define.CAP", "1"}, {"simulation.steps", "14"}}), up) < 1e-6);
}
