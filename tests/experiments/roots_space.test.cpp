// Two root systems in one soil, and their controls: one root, no depletion, far apart, slower rootlets.
#include "catch.h"
#include "experiments/roots.h"

#include <numeric>

using namespace espalier;

namespace {

constexpr int seeds_in_space = 20;
constexpr double depth = -0.6;    ///< where distances are measured, m
constexpr double planted = 0.12;  ///< how far apart the roots begin, m
constexpr std::size_t left = 0, right = 1;

/// What is left of a run: its main roots, where they cross `depth`, and how the water was.
struct Crossing {
    std::vector<std::vector<glm::dvec3>> nodes;  ///< nodes of each main root
    std::vector<glm::dvec3> main;                ///< where each crosses
    double worst_balance = 0, least_content = 0, drunk = 0;

    double distance() const { return glm::length(main[right] - main[left]); }
};

Crossing cross(const std::string& scene, const SceneOptions& options) {
    const Grown grown = grow_watched("environments/" + scene, options);
    Crossing crossing;
    crossing.worst_balance = grown.worst_balance;
    crossing.least_content = grown.least_content;
    crossing.drunk = grown.drunk;
    for (std::size_t plant = 0; plant < grown.world->size(); ++plant) {
        const RootSystem root = root_system(*grown.world, plant);
        crossing.nodes.push_back(root.main);
        crossing.main.push_back(main_root_at(root, depth));
    }
    return crossing;
}

/// Seeds 1 to 20 of a scene, grown once.
const std::vector<Crossing>& twenty(const char* scene) {
    static std::map<std::string, std::vector<Crossing>> grown;
    std::vector<Crossing>& runs = grown[scene];
    for (int seed = static_cast<int>(runs.size()) + 1; seed <= seeds_in_space; ++seed) {
        runs.push_back(cross(scene, with_seed(seed)));
    }
    return runs;
}

struct Sample {
    double mean, error;  ///< standard error of the mean
};

Sample sample(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

/// How far main roots have moved along x until `depth`, away from where they were planted.
std::vector<double> drifts(const std::vector<Crossing>& runs, std::size_t plant, double from) {
    std::vector<double> result;
    for (const Crossing& run : runs) result.push_back(run.main[plant].x - from);
    return result;
}

}  // namespace

TEST_CASE("two roots: both main roots bend away from each other in at least 19 of 20 seeds", "[roots]") {
    int both = 0;
    for (const Crossing& run : twenty("two-roots.toml")) {
        both += run.main[left].x < -planted / 2 && run.main[right].x > planted / 2;
        CHECK(run.distance() > planted);
    }
    CHECK(both >= 19);
}

TEST_CASE("two roots: a root alone keeps straight on average, and bends less than the same root with a neighbour",
          "[roots]") {
    const std::vector<double> alone = drifts(twenty("one-root.toml"), left, -planted / 2);
    const std::vector<double> paired = drifts(twenty("two-roots.toml"), left, -planted / 2);
    const Sample straight = sample(alone), bent = sample(paired);
    CHECK(std::abs(straight.mean) < 0.2 * std::abs(bent.mean));
    CHECK(bent.mean < -3 * bent.error);
    int away = 0;
    for (int seed = 0; seed < seeds_in_space; ++seed) away += paired[seed] < alone[seed];
    CHECK(away >= 19);
}

TEST_CASE("two roots: without depletion a root does not feel its neighbour at all, and the distance stays", "[roots]") {
    const auto& two = twenty("two-roots-no-depletion.toml");
    std::vector<double> gain;
    for (int seed = 1; seed <= seeds_in_space; ++seed) {
        SceneOptions alone = with_seed(seed);
        alone.overrides = {{"environment.water.depletion", "false"}};
        if (seed <= 5) CHECK(cross("one-root.toml", alone).nodes[left] == two[seed - 1].nodes[left]);
        gain.push_back(two[seed - 1].distance() - planted);
    }
    std::vector<double> with_depletion;
    for (const Crossing& run : twenty("two-roots.toml")) with_depletion.push_back(run.distance() - planted);
    CHECK(std::abs(sample(gain).mean) < 0.1 * sample(with_depletion).mean);
}

TEST_CASE("two roots: two metres apart each grows as if it were alone", "[roots]") {
    SceneOptions wide = with_seed(1);
    wide.overrides = {{"environment.water.domain.upper", "[2.6, 0, 0.4]"}};
    const Crossing alone = cross("one-root.toml", wide);
    const Crossing apart = cross("two-roots-apart.toml", with_seed(1));
    CHECK(glm::length(apart.main[left] - alone.main[left]) < 1e-9);
    CHECK(glm::length(apart.main[right] - glm::dvec3(2, depth, 0)) < 0.1);
}

TEST_CASE("two roots: the slower the rootlets, the closer the main roots", "[roots]") {
    std::vector<Sample> distances;
    for (const char* speed : {"0.004", "0.008", "0.012", "0.016"}) {
        std::vector<double> values;
        for (int seed = 1; seed <= 10; ++seed) {
            SceneOptions options = with_seed(seed);
            options.overrides = {{"plant.0.define.ROOTLET_SPEED", speed}};
            values.push_back(cross("two-roots.toml", options).distance());
        }
        distances.push_back(sample(values));
        CAPTURE(speed, distances.back().mean, distances.back().error);
        CHECK(distances.back().mean > planted);
    }
    for (std::size_t i = 1; i < distances.size(); ++i) {
        const double noise = std::hypot(distances[i].error, distances[i - 1].error);
        CHECK(distances[i].mean > distances[i - 1].mean - noise);
    }
    const double noise = std::hypot(distances.front().error, distances.back().error);
    CHECK(distances.back().mean > distances.front().mean + 3 * noise);
}

TEST_CASE("two roots: water is balanced to 1e-9 in every step, drunk, and never negative", "[roots]") {
    for (const char* scene : {"two-roots.toml", "one-root.toml"}) {
        for (const Crossing& run : twenty(scene)) {
            CHECK(run.worst_balance <= 1e-9);
            CHECK(run.least_content >= 0);
            CHECK(run.drunk > 0);
        }
    }
}
