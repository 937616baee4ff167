// One root in a plane of soil: an S of wet soil, its controls, and stones.
#include "espalier/environment/shape.h"

#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

constexpr int seeds_in_plane = 10;
constexpr double wet_enough = 0.18;  ///< half way between dry and wet in root-2d.toml
constexpr double end_of_s = -1.08;   ///< the S reaches down to here, m

/// Seeds 1 to 10 of a scene, grown once.
const std::vector<Grown>& ten(const char* scene) {
    static std::map<std::string, std::vector<Grown>> grown;
    std::vector<Grown>& runs = grown[scene];
    for (int seed = static_cast<int>(runs.size()) + 1; seed <= seeds_in_plane; ++seed) {
        runs.push_back(grow_watched(std::string("environments/") + scene, with_seed(seed)));
    }
    return runs;
}

const Soil& prepared_s() {
    return ten("root-2d.toml").front().prepared;
}

/// The part of the main root above the end of the S that lies in wet soil, by length.
double wet_fraction(const RootSystem& root) {
    double wet = 0, all = 0;
    for (std::size_t i = 1; i < root.main.size() && root.main[i].y >= end_of_s; ++i) {
        const double length = glm::length(root.main[i] - root.main[i - 1]);
        all += length;
        if (prepared_s().content(0.5 * (root.main[i] + root.main[i - 1])) >= wet_enough) wet += length;
    }
    return wet / all;
}

struct Thirds {
    double driest, wettest;  ///< mean length of rootlets
};

/// Rootlets ordered by how wet the S is on the way they set out on, for as long as the longest of them.
Thirds lengths_by_wetness(const std::vector<Grown>& runs) {
    std::vector<std::pair<double, double>> by_wetness;
    for (const Grown& run : runs) {
        for (const Rootlet& rootlet : root_system(*run.world).rootlets) {
            by_wetness.emplace_back(prepared_s().content(rootlet.base, rootlet.base + 0.2 * rootlet.heading),
                                    rootlet.length);
        }
    }
    std::sort(by_wetness.begin(), by_wetness.end());
    const std::size_t third = by_wetness.size() / 3;
    const auto mean = [&](std::size_t first) {
        double sum = 0;
        for (std::size_t i = first; i < first + third; ++i) sum += by_wetness[i].second;
        return sum / static_cast<double>(third);
    };
    return {mean(0), mean(by_wetness.size() - third)};
}

}  // namespace

TEST_CASE(
    "root 2d: the main root keeps at least 0.8 of its length in the S; one that does not feel water, less than half",
    "[roots]") {
    for (const Grown& run : ten("root-2d.toml")) {
        const RootSystem root = root_system(*run.world);
        CHECK(wet_fraction(root) >= 0.8);
        CHECK(root.main.back().y < 0.8 * end_of_s);  // it has followed both bends
    }
    for (const Grown& run : ten("root-2d-blind.toml")) CHECK(wet_fraction(root_system(*run.world)) < 0.5);
}

TEST_CASE("root 2d: rootlets that set out into the wettest third grow at least half as long again as in the driest",
          "[roots]") {
    const Thirds thirds = lengths_by_wetness(ten("root-2d.toml"));
    CHECK(thirds.wettest >= 1.5 * thirds.driest);
    for (const Grown& run : ten("root-2d.toml")) CHECK(root_system(*run.world).unfinished == 0);
}

TEST_CASE("root 2d: in uniform soil rootlets of the same places do not differ", "[roots]") {
    const Thirds thirds = lengths_by_wetness(ten("root-2d-uniform.toml"));
    CHECK(thirds.wettest == Approx(thirds.driest).epsilon(0.02));
}

TEST_CASE("root 2d: water is balanced to 1e-9 in every step, drunk, and never negative", "[roots]") {
    for (const char* scene : {"root-2d.toml", "root-2d-blind.toml", "root-2d-uniform.toml", "root-2d-stones.toml"}) {
        for (const Grown& run : ten(scene)) {
            CHECK(run.worst_balance <= 1e-9);
            CHECK(run.least_content >= 0);
            CHECK(run.drunk > 0);
        }
    }
}

TEST_CASE("root 2d: no node of any root lies in a stone, though the way down is blocked", "[roots]") {
    const Scene scene = read_scene(source_path("environments/root-2d-stones.toml"));
    std::vector<std::shared_ptr<const Shape>> stones;
    Settings soil = scene.environment.processes.front().second;
    for (Settings& table : soil.tables("obstacles")) stones.push_back(read_shape(table));
    REQUIRE(stones.size() == 14);
    const auto in_stone = [&](const glm::dvec3& point) {
        return std::any_of(stones.begin(), stones.end(), [&](const auto& stone) { return stone->inside(point); });
    };
    const auto nodes_in_stones = [&](const Grown& run) {
        const auto& internodes = run.world->interpretation(0).geometry.internodes;
        return std::count_if(internodes.begin(), internodes.end(),
                             [&](const Internode& internode) { return in_stone(internode.tip); });
    };
    for (const Grown& run : ten("root-2d-stones.toml")) {
        CHECK(nodes_in_stones(run) == 0);
        CHECK(root_system(*run.world).main.back().y < -1);
    }
    // Without stones in its way a root would grow through where they lie.
    for (const Grown& run : ten("root-2d-uniform.toml")) CHECK(nodes_in_stones(run) > 20);
}

TEST_CASE("root 2d: in dry soil nothing grows", "[roots]") {
    SceneOptions dry = with_seed(1);
    dry.overrides = {{"environment.water.initial", "0"}, {"simulation.steps", "20"}};
    const Grown run = grow_watched("environments/root-2d-uniform.toml", dry);
    CHECK(run.world->interpretation(0).geometry.internodes.empty());
    CHECK(run.drunk == 0);
}

TEST_CASE("root 2d: a root that is shut in grows nowhere, not straight up", "[roots]") {
    SceneOptions shut = with_seed(1);
    shut.overrides = {{"environment.water.domain.lower", "[-0.015, -0.015, 0]"},
                      {"environment.water.domain.upper", "[0.015, 0, 0]"},
                      {"environment.water.initial", "1"},
                      {"plant.0.define.MAIN_SPEED", "0.03"},
                      {"simulation.steps", "5"}};
    const Grown run = grow_watched("environments/root-2d-uniform.toml", shut);
    CHECK(run.world->interpretation(0).geometry.internodes.empty());
    CHECK(run.drunk > 0);
}
