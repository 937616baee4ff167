// Roots that grow along stones, roots that do not feel them, and roots without stones.
#include "espalier/environment/shape.h"

#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

using namespace espalier;

namespace {

struct Roots {
    double depth = 0;      ///< mean of the axes' lowest points, m
    double length = 0;     ///< of all axes, m
    double touching = 0;   ///< share of the nodes that are within two millimetres of a stone
    double clearance = 1;  ///< least distance of a point of a root to a stone, m
};

Roots roots(std::uint64_t seed, std::vector<std::pair<std::string, std::string>> overrides = {}) {
    SceneOptions options;
    options.seed = seed;
    options.overrides = std::move(overrides);
    const Scene scene = read_scene(source_path("environments/stones.toml"), options);
    Settings settings = scene.environment.processes.front().second;
    const auto stones = read_shape(settings);
    World world(scene);
    world.start();
    while (!world.at_end()) world.step();
    Roots found;
    std::map<std::uint32_t, double> lowest;
    int nodes = 0, touching = 0;
    for (const Internode& piece : world.interpretation(0).geometry.internodes) {
        found.length += glm::length(piece.tip - piece.base);
        lowest[piece.axis] = std::min(lowest[piece.axis], piece.tip.y);
        ++nodes;
        touching += stones->distance(piece.tip) < 0.002;
        for (const double along : {0.25, 0.5, 0.75, 1.0}) {
            found.clearance = std::min(found.clearance, stones->distance(glm::mix(piece.base, piece.tip, along)));
        }
    }
    for (const auto& [axis, y] : lowest) found.depth -= y / double(lowest.size());
    found.touching = double(touching) / nodes;
    return found;
}

}  // namespace

TEST_CASE("roots grow along stones and past them; those that do not feel stay above", "[thigmotropism]") {
    for (const std::uint64_t seed : {1, 2, 3, 61, 62, 63}) {
        const Roots feeling = roots(seed), numb = roots(seed, {{"plant.0.define.TOUCH", "0"}}),
                    free = roots(seed, {{"environment.stone.translate", "[0, 10, 0]"}});
        INFO("seed " << seed << ": mean depth " << feeling.depth << " m, numb " << numb.depth << ", without stones "
                     << free.depth << "; length " << feeling.length << ", " << numb.length << ", " << free.length
                     << " m; nodes at a stone " << feeling.touching << ", " << numb.touching << "; clearance "
                     << feeling.clearance << ", " << numb.clearance << " m");
        CHECK(feeling.clearance >= 0.0005 - 1e-9);
        CHECK(numb.clearance >= 0.0005 - 1e-9);
        CHECK(feeling.depth > 0.75 * free.depth);
        CHECK(numb.depth < 0.7 * feeling.depth);
        CHECK(feeling.length == Approx(free.length).epsilon(0.02));
        CHECK(feeling.touching > 0.05);
    }
}

TEST_CASE("thick roots that grow slowly keep half their diameter from the stones, too", "[thigmotropism]") {
    for (const std::uint64_t seed : {5, 65}) {
        const Roots thick = roots(
            seed, {{"plant.0.define.WIDTH", "0.01"}, {"plant.0.define.RATE", "0.002"}, {"simulation.steps", "90"}});
        INFO("seed " << seed << ": clearance " << thick.clearance << " m, length " << thick.length << " m");
        CHECK(thick.clearance >= 0.005 - 1e-9);
        CHECK(thick.length > 1);
    }
}

TEST_CASE("a root that meets a flat stone head on grows along its upper side", "[thigmotropism]") {
    SceneOptions options;
    options.overrides = {
        {"environment.stone.of", "[{ shape = \"box\", lower = [-1, -0.3, -1], upper = [1, -0.093, 1] }]"},
        {"plant.0.define.AXES", "1"},
        {"plant.0.define.ANGLE", "0"}};
    const auto world = grown("environments/stones.toml", options);
    const auto& pieces = world->interpretation(0).geometry.internodes;
    const double above = pieces.back().tip.y + 0.093;
    CHECK(above == Approx(0.001).margin(1e-9));  // a diameter
    CHECK(pieces[pieces.size() - 12].tip.y == Approx(pieces.back().tip.y).margin(1e-9));
}
