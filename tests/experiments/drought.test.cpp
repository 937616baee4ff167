// A dry season: which of two root systems still transpires.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

struct Season {
    int first_short = 0;             ///< day of less than 0.95 of the demand; 0: never
    int wilted = 0;                  ///< days in a row with less than half of the demand
    double last = 0, total = 0;      ///< transpiration of the last day, and of all, cm3
    std::vector<double> depth = {};  ///< of the uptake of each day, cm
    double length = 0;               ///< of roots at the end, m
};

Season season(const std::string& plant, const SceneOptions& options) {
    const Scene scene = read_scene(source_path("environments/drought-" + plant + ".toml"), options);
    World world(scene);
    world.start();
    Season season;
    int wilting = 0;
    while (!world.at_end()) {
        world.step();
        season.last = quantity(world, "roots.transpiration");
        season.depth.push_back(quantity(world, "roots.depth"));
        const bool is_short = season.last < 0.95 * quantity(world, "roots.demand");
        const bool wilts = season.last < 0.5 * quantity(world, "roots.demand") && world.steps_done() > 10;
        wilting = wilts ? wilting + 1 : 0;
        season.wilted = std::max(season.wilted, wilting);
        // Seedlings that have no roots yet do not count.
        if (is_short && season.first_short == 0 && world.steps_done() > 10) season.first_short = world.steps_done();
    }
    season.total = quantity(world, "roots.total");
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        season.length += glm::length(internode.tip - internode.base);
    }
    return season;
}

}  // namespace

TEST_CASE("in a dry season deep roots transpire on where shallow ones have dried their soil", "[drought]") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Season deep = season("deep", with_seed(seed)), shallow = season("shallow", with_seed(seed));
        INFO("seed " << seed << ": wilted for " << deep.wilted << " and " << shallow.wilted
                     << " days; short of water from day " << deep.first_short << " and " << shallow.first_short
                     << "; last day " << deep.last << " and " << shallow.last << " cm3; in all " << deep.total
                     << " and " << shallow.total << " cm3; depth of uptake " << deep.depth[19] << " to "
                     << deep.depth[59] << " and " << shallow.depth[19] << " to " << shallow.depth[59] << " cm; length "
                     << deep.length << " and " << shallow.length << " m");
        CHECK(shallow.first_short > 20);
        CHECK(deep.first_short > shallow.first_short + 10);
        CHECK(deep.wilted < 15);  // who dies of 20 days in a row: the shallow plant alone
        CHECK(shallow.wilted > 25);
        CHECK(deep.total > 1.5 * shallow.total);
        CHECK(deep.last > 2 * shallow.last);
        CHECK(deep.depth[59] > deep.depth[19] + 30);
        CHECK(shallow.depth[59] < 20);
        CHECK(deep.length == Approx(shallow.length).epsilon(0.2));
    }
}

TEST_CASE("with rain on every day deep and shallow roots transpire alike", "[drought]") {
    SceneOptions rain;
    rain.overrides = {{"environment.water.boundaries.top.rain", "5"}};
    const Season deep = season("deep", rain), shallow = season("shallow", rain);
    CHECK(deep.wilted + shallow.wilted == 0);
    CHECK(deep.first_short == 0);
    CHECK(shallow.first_short == 0);
    CHECK(deep.total == Approx(shallow.total).epsilon(1e-6));
}
