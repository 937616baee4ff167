// Split roots: the half in wet soil takes up what the half in dry soil cannot.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

/// Of the last day, cm3.
struct Halves {
    double dry = 0, wet = 0, transpired = 0;
};

Halves halves(std::uint64_t seed, std::vector<std::pair<std::string, std::string>> overrides = {}) {
    SceneOptions options = with_seed(seed);
    options.overrides = std::move(overrides);
    const auto world = grown("environments/split-pot.toml", options);
    const auto field = world->environment().fields().need("roots").grid;
    Halves found;
    for (auto voxel = field->grid->cbeginValueOn(); voxel; ++voxel) {
        const bool left = field->grid->indexToWorld(voxel.getCoord()).x() < 0;
        (left ? found.dry : found.wet) += 27.0 * *voxel;  // voxels of 27 cm3
    }
    found.transpired = quantity(*world, "roots.transpiration");
    return found;
}

}  // namespace

TEST_CASE("the half of the roots in wet soil compensates for the half in dry soil", "[split-pot]") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Halves split = halves(seed);
        const Halves both_wet = halves(seed, {{"environment.water.regions.0.initial.head", "-100"}});
        const Halves feddes = halves(seed, {{"environment.roots.model", "\"feddes\""}});
        INFO("seed " << seed << ": dry half " << split.dry << ", wet half " << split.wet << " cm3; both wet "
                     << both_wet.dry << " and " << both_wet.wet << "; Feddes " << feddes.dry << " and " << feddes.wet);
        CHECK(split.transpired == Approx(10).epsilon(1e-3));
        CHECK(split.wet > 1.8 * both_wet.wet);
        CHECK(split.dry < 0.05 * split.wet);
        CHECK(both_wet.wet == Approx(both_wet.dry).epsilon(0.1));
        CHECK(feddes.wet == Approx(both_wet.wet).epsilon(0.15));
        CHECK(feddes.transpired < 0.6 * split.transpired);
    }
}
