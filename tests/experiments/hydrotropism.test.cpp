// A root that turns to water, and roots that have no reason to.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

/// Where the tip is, m.
glm::dvec3 tip(std::uint64_t seed, std::vector<std::pair<std::string, std::string>> overrides = {}) {
    SceneOptions options = with_seed(seed);
    options.overrides = std::move(overrides);
    const auto world = grown("environments/hydrotropism.toml", options);
    return world->interpretation(0).geometry.internodes.back().tip;
}

}  // namespace

TEST_CASE("a root turns to the wet side; one that senses no water, or finds it everywhere, grows down",
          "[hydrotropism]") {
    double wet_side = 0, blind_sides = 0, even_sides = 0;
    const int seeds = 5;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const glm::dvec3 turned = tip(seed), blind = tip(seed, {{"plant.0.define.HYDRO", "0"}}),
                         even = tip(seed, {{"environment.water.initial.head", "-100"}});
        UNSCOPED_INFO("seed " << seed << ": tip at x = " << turned.x << " m, y = " << turned.y << "; blind " << blind.x
                              << "; evenly wet " << even.x);
        CHECK(turned.x > 0.04);
        CHECK(std::abs(blind.x) < 0.5 * turned.x);
        wet_side += turned.x / seeds;
        blind_sides += std::abs(blind.x) / seeds;
        even_sides += std::abs(even.x) / seeds;
    }
    INFO("mean " << wet_side << ", blind " << blind_sides << ", evenly wet " << even_sides);
    CHECK(wet_side > 4 * blind_sides);
    CHECK(wet_side > 4 * even_sides);
}
