// The course of models, 08 to 10: plants that talk to light, water and a shape.
#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace espalier;

namespace {

double quantity_named(const World& world, const std::string& name) {
    for (const Quantity& each : world.environment().statistics(0)) {
        if (each.name == name) return each.value;
    }
    FAIL("no quantity " << name);
    return 0;
}

std::size_t apices(const World& world) {
    return world.interpretation(0).queries.size();
}

// The part of a plant's length that lies at x > 0.
double right_share(const World& world) {
    double right = 0;
    const PlantGeometry& geometry = world.interpretation(0).geometry;
    for (const Internode& internode : geometry.internodes) {
        if (internode.tip.x > 0) right += glm::distance(internode.tip, internode.base);
    }
    return right / total_length(geometry);
}

}  // namespace

TEST_CASE("08: without shadows every apex forks each step; with them the shaded ones sleep", "[course]") {
    SceneOptions unshaded;
    unshaded.overrides = {{"plant.0.define.SHADOW", "0"}};
    CHECK(apices(*grown("environments/course-light.toml", unshaded)) == 1024);

    const auto world = grown("environments/course-light.toml");
    CHECK(apices(*world) < 800);
    CHECK(apices(*world) > 100);

    // One more step: exactly the apices with enough light become two.
    const auto& queries = world->interpretation(0).queries;
    const auto lit =
        std::count_if(queries.begin(), queries.end(), [](const Query& q) { return q.parameters[0] > 0.6; });
    const std::size_t before = queries.size();
    world->step();
    CHECK(apices(*world) == before + static_cast<std::size_t>(lit));
}

TEST_CASE("09: roots avoid the stone, grow more where it is wet, and every drop is accounted for", "[course]") {
    const auto world = grown("environments/course-water.toml");
    for (const Internode& internode : world->interpretation(0).geometry.internodes) {
        CHECK(glm::distance(internode.tip, glm::dvec3(0.15, -0.6, 0)) >= 0.15 - 1e-3);
    }
    CHECK(quantity_named(*world, "water.drunk") > 100);
    CHECK(std::abs(quantity_named(*world, "water.balance")) < 1e-9);
    CHECK(quantity_named(*world, "water.minimum") >= 0);

    // The wet region is on the right; without it the stone there leaves more roots on the left.
    SceneOptions uniform;
    uniform.overrides = {{"environment.water.regions.0.value", "0.1"}};
    CHECK(right_share(*world) > right_share(*grown("environments/course-water.toml", uniform)) + 0.05);
}

TEST_CASE("10: the plant fills the ball and is cut where it leaves it", "[course]") {
    const auto world = grown("environments/course-shape.toml");
    const PlantGeometry& geometry = world->interpretation(0).geometry;
    REQUIRE(geometry.internodes.size() > 100);
    const glm::dvec3 centre(0, 1.5, 0);
    for (const Internode& internode : geometry.internodes) {
        CHECK(glm::distance(internode.base, centre) <= 1.5 + 0.02);
        CHECK(glm::distance(internode.tip, centre) <= 1.5 + 0.3);
    }
    for (double reach : {geometry.bounds.upper.x, -geometry.bounds.lower.x, geometry.bounds.upper.z})
        CHECK(reach > 1.2);
}
