// Maize and lupine share the water of one soil: the land equivalent ratio over the sole stands.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

/// What the two plants of a scene have transpired, cm3.
std::pair<double, double> transpired(const std::string& scene, const SceneOptions& options) {
    const auto world = grown("environments/" + scene, options);
    return {quantity(*world, "roots.total", 0), quantity(*world, "roots.total", 1)};
}

struct Ratios {
    double maize = 0, lupine = 0;  ///< yield of the one plant in the mixture over that of the two of the sole stand

    double land_equivalent() const { return maize + lupine; }
};

/// Yields are proportional to transpiration.
Ratios ratios(const SceneOptions& options) {
    const auto [maize, lupine] = transpired("intercrop.toml", options);
    const auto [maize_1, maize_2] = transpired("intercrop-maize.toml", options);
    const auto [lupine_1, lupine_2] = transpired("intercrop-lupine.toml", options);
    return {maize / (maize_1 + maize_2), lupine / (lupine_1 + lupine_2)};
}

}  // namespace

TEST_CASE("two species of different depth use the water of a dry soil better than each alone", "[intercrop]") {
    std::vector<double> land;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Ratios found = ratios(with_seed(seed));
        UNSCOPED_INFO("seed " << seed << ": maize " << found.maize << ", lupine " << found.lupine
                              << ", land equivalent ratio " << found.land_equivalent());
        CHECK(found.land_equivalent() > 1.05);
        CHECK(found.lupine > 0.55);
        land.push_back(found.land_equivalent());
    }
    double mean = 0, squares = 0;
    for (double one : land) mean += one / double(land.size());
    for (double one : land) squares += (one - mean) * (one - mean);
    const double deviation = std::sqrt(squares / double(land.size() - 1));
    INFO("mean " << mean << ", standard deviation " << deviation);
    CHECK(mean - 1 > 2 * deviation);
}

TEST_CASE("with rain on every day two species gain nothing from each other", "[intercrop]") {
    SceneOptions rain;
    rain.overrides = {{"environment.water.boundaries.top.rain", "6"}};
    CHECK(ratios(rain).land_equivalent() == Approx(1).margin(0.005));
}
