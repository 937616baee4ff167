// Roots above a plough pan: strong soil and cold soil slow them, where they are and when.
#include "catch.h"
#include "experiments/roots.h"
#include "temporary_folder.h"

using namespace espalier;

namespace {

struct Lengths {
    double above = 0, below = 0;  ///< m, of the lower end of the pan
    double tilled = 0;            ///< of it above the soil that the pan makes stronger
    double all() const { return above + below; }
    double share_below() const { return below / all(); }
};

/// Of a season with other tables of the soil: "" leaves them.
Lengths grown(std::uint64_t seed, const std::string& strength, const std::string& temperature, int steps = 60) {
    SceneOptions options = with_seed(seed);
    options.steps = steps;
    if (!strength.empty()) options.overrides.push_back({"environment.strength.file", "soils/" + strength});
    if (!temperature.empty()) options.overrides.push_back({"environment.temperature.file", "soils/" + temperature});
    World world(read_scene(source_path("environments/plough-pan.toml"), options));
    world.start();
    while (!world.at_end()) world.step();
    Lengths lengths;
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        const double length = glm::length(internode.tip - internode.base);
        (internode.tip.y < -0.3 ? lengths.below : lengths.above) += length;
        if (internode.tip.y > -0.22) lengths.tilled += length;
    }
    return lengths;
}

}  // namespace

TEST_CASE("a plough pan keeps roots above it, and cold soil makes them fewer", "[plough-pan]") {
    for (const std::uint64_t seed : {1, 2, 3, 41, 42, 43}) {
        const Lengths pan = grown(seed, "", "summer.csv"), loose = grown(seed, "loose.csv", "summer.csv");
        const Lengths cold = grown(seed, "", ""), cold_loose = grown(seed, "loose.csv", "");
        INFO("seed " << seed << ": share of the length below the pan " << pan.share_below() << ", without it "
                     << loose.share_below() << "; length " << pan.all() << " and " << loose.all() << " m; in spring "
                     << cold.all() << " and " << cold_loose.all() << " m, below " << cold.share_below() << " and "
                     << cold_loose.share_below());
        CHECK(pan.share_below() > 0);
        CHECK(pan.share_below() < 0.65 * loose.share_below());
        CHECK(pan.tilled == Approx(loose.tilled).epsilon(0.03));
        CHECK(cold.all() < 0.75 * pan.all());
        CHECK(cold_loose.all() < 0.6 * loose.all());
        CHECK(cold_loose.share_below() < 0.5 * loose.share_below());
    }
}

TEST_CASE("a root in uniform soil is as long as the law of growth in its own time says", "[plough-pan]") {
    // Strength 1.25 MPa is half of the strongest, and 16.5 degrees are half way from the coldest to the warm.
    TemporaryFolder tables;
    tables.write("strength.csv", "time, 0\n0, 1.25\n");
    tables.write("temperature.csv", "time, 0\n0, 16.5\n");
    SceneOptions options;
    options.overrides = {{"environment.strength.file", (tables.path() / "strength.csv").string()},
                         {"environment.temperature.file", (tables.path() / "temperature.csv").string()},
                         {"plant.0.define.WIGGLE", "0"}};
    World world(read_scene(source_path("environments/plough-pan.toml"), options));
    world.start();
    while (!world.at_end()) world.step();
    const double age = 1 + 0.25 * (60 - 2);  // axes begin in the second step, and ask from its end on
    double longest = 0;
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        if (internode.order == 1) longest = std::max(longest, glm::length(internode.tip));
    }
    CHECK(longest == Approx(1 - std::exp(-0.03 * age)).epsilon(1e-6));
}
