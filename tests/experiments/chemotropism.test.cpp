// A root that turns to a nutrient, one that turns away, and roots that have no reason to.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

/// How far the tip is on the side of the band, m.
double side(std::uint64_t seed, std::vector<std::pair<std::string, std::string>> overrides = {}) {
    SceneOptions options = with_seed(seed);
    options.overrides = std::move(overrides);
    const auto world = grown("environments/chemotropism.toml", options);
    return world->interpretation(0).geometry.internodes.back().tip.x;
}

}  // namespace

TEST_CASE("a root turns to fertiliser or away from it; one that senses none, or finds it everywhere, grows down",
          "[chemotropism]") {
    double towards = 0, away = 0, blind_sides = 0, even_sides = 0;
    const std::vector<std::uint64_t> seeds{1, 2, 3, 51, 52, 53};
    for (const std::uint64_t seed : seeds) {
        const double turned = side(seed), fled = side(seed, {{"plant.0.define.CHEMO", "-0.25"}}),
                     blind = side(seed, {{"plant.0.define.CHEMO", "0"}}),
                     even = side(seed, {{"environment.nitrate.initial", "10"}});
        UNSCOPED_INFO("seed " << seed << ": tip at x = " << turned << " m; away " << fled << "; blind " << blind
                              << "; evenly rich " << even);
        CHECK(turned > 0.04);
        CHECK(turned < 0.13);
        CHECK(fled < 0);
        towards += turned / double(seeds.size());
        away += fled / double(seeds.size());
        blind_sides += std::abs(blind) / double(seeds.size());
        even_sides += std::abs(even) / double(seeds.size());
    }
    INFO("mean " << towards << ", away " << away << ", blind " << blind_sides << ", evenly rich " << even_sides);
    CHECK(towards > 4 * blind_sides);
    CHECK(towards > 4 * even_sides);
    CHECK(-away > 2 * blind_sides);
}
