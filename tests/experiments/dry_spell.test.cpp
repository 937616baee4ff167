// Roots die in a layer that dries out, and grow again after the rain.
#include "catch.h"
#include "experiments/growth.h"

using namespace espalier;

namespace {

/// Tips by what they are, above and below the layer that dries out.
struct Tips {
    std::map<std::string, int> above, below;
};

Tips tips_of(const World& world) {
    Tips tips;
    const ModuleString& string = world.string(0);
    for (const Query& query : world.interpretation(0).queries) {
        const std::string name(world.model(0).alphabet.name(string.letters[query.module - 1]));
        const double y = query.pose.position.y;
        if (y > -0.18) ++tips.above[name];
        if (y < -0.24) ++tips.below[name];
    }
    return tips;
}

/// After days 18, 38 and 60.
std::vector<Tips> grown(std::uint64_t seed, const std::string& heads) {
    SceneOptions options;
    options.seed = seed;
    if (!heads.empty()) options.overrides = {{"environment.head.file", "soils/" + heads}};
    World world(read_scene(source_path("environments/dry-spell.toml"), options));
    world.start();
    std::vector<Tips> found;
    while (!world.at_end()) {
        world.step();
        if (world.steps_done() == 18 || world.steps_done() == 38 || world.steps_done() == 60) {
            found.push_back(tips_of(world));
        }
    }
    return found;
}

}  // namespace

TEST_CASE("tips in a layer that dries out die, those below live, and after rain all grow again", "[dry-spell]") {
    for (const std::uint64_t seed : {1, 2, 3, 17, 18}) {
        const std::vector<Tips> days = grown(seed, "");
        Tips moist = days[0], dry = days[1], rained = days[2];
        INFO("seed " << seed << ": living tips above " << moist.above["R"] << ", in the dry spell " << dry.above["R"]
                     << " and dead ones " << dry.above["D"] << ", after it " << rained.above["R"]
                     << "; living tips below " << dry.below["R"]);
        CHECK(moist.above["D"] + moist.below["D"] == 0);
        CHECK(dry.above["D"] > 50);
        CHECK(dry.above["D"] > 0.8 * moist.above["R"]);
        CHECK(dry.below["D"] + dry.below["W"] == 0);
        CHECK(dry.below["R"] > 50);
        CHECK(rained.above["D"] + rained.above["W"] == 0);
        CHECK(rained.above["R"] >= moist.above["R"]);
    }
}

TEST_CASE("in soil that stays wet no tip dies", "[dry-spell]") {
    for (Tips& tips : grown(1, "wet.csv")) {
        CHECK(tips.above["D"] + tips.above["W"] + tips.below["D"] + tips.below["W"] == 0);
        CHECK(tips.above["R"] > 50);
    }
}
