// Who answers: the scene's default process, two processes by name in one string, three processes at once.
#include "espalier/environment/shape.h"

#include "catch.h"
#include "experiments/growth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace espalier;

namespace {

/// The queries of plant `plant` to process `process` ("E" is the default one), as answered, by identity.
struct Asked {
    glm::dvec3 position;
    std::vector<double> answer;
};
std::map<Identity, Asked> asked(const World& world, std::size_t plant, const std::string& process) {
    std::map<Identity, Asked> found;
    const ModuleString& string = world.string(plant);
    for (const Query& query : world.interpretation(plant).queries) {
        if (world.model(plant).alphabet.name(string.letters[query.module]) != process) continue;
        const double* first = string.parameters.data() + query.parameters_at;
        found[query.identity] = {query.pose.position, {first, first + query.parameters.size()}};
    }
    return found;
}

std::map<std::string, int> counts(const World& world, std::size_t plant) {
    std::map<std::string, int> counts;
    for (LetterId letter : world.string(plant).letters) ++counts[world.model(plant).alphabet.name(letter)];
    return counts;
}

double statistic(const World& world, const std::string& name, std::uint32_t plant = 0) {
    for (const Quantity& quantity : world.environment().statistics(plant)) {
        if (quantity.name == name) return quantity.value;
    }
    FAIL("no statistic " << name);
    return 0;
}

std::shared_ptr<const Shape> shape_of(const std::string& file, const std::string& process) {
    const Scene scene = read_scene(source_path(file));
    for (const auto& [name, table] : scene.environment.processes) {
        if (name != process) continue;
        Settings settings = table;
        return read_shape(settings);
    }
    return nullptr;
}

}  // namespace

TEST_CASE("?E goes to the default process: as many apices branch in a step as it gave light enough", "[processes]") {
    World world(read_scene(source_path("environments/default-process.toml")));
    REQUIRE(world.environment().default_process() == world.environment().find("light"));
    world.start();
    int rested = 0;
    for (int step = 1; step <= 12; ++step) {
        int lit = 0, dark = 0;
        for (const auto& [identity, query] : asked(world, 0, "E")) ++(query.answer[0] >= 0.5 ? lit : dark);
        world.step();
        CHECK(counts(world, 0)["A"] == 2 * lit + dark);
        rested += dark;
    }
    CHECK(rested > 100);
}

TEST_CASE("?E without shadows doubles the apices in every step", "[processes]") {
    const auto world = grown("environments/default-process.toml", {{{"plant.0.define.SHADOW", "0"}}, {}, {}});
    CHECK(counts(*world, 0)["A"] == 4096);
}

TEST_CASE("two processes by name: ivy follows the wall, and leaves in the dark are shed", "[processes]") {
    const std::string file = "environments/two-processes.toml";
    const auto wall = shape_of(file, "wall");
    World world(read_scene(source_path(file)));
    world.start();
    double nearest = 1, farthest = 0;
    int shed = 0;
    for (int step = 1; step <= 60; ++step) {
        std::vector<std::map<Identity, Asked>> light;
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            light.push_back(asked(world, plant, "?light"));
            for (const auto& [identity, query] : asked(world, plant, "?wall")) {
                CHECK(query.answer[1] == Approx(wall->distance(query.position)).margin(1e-12));
            }
        }
        world.step();
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            // A question that is gone was a leaf's, and answered by less than a leaf needs.
            const auto now = asked(world, plant, "?light");
            for (const auto& [identity, query] : light[plant]) {
                if (now.contains(identity)) continue;
                CHECK(query.answer[0] < 0.3);
                ++shed;
            }
        }
    }
    for (std::size_t plant = 0; plant < world.size(); ++plant) {
        for (const Internode& internode : world.interpretation(plant).geometry.internodes) {
            const double distance = wall->distance(internode.tip);
            nearest = std::min(nearest, distance);
            farthest = std::max(farthest, distance);
        }
        CHECK(statistic(world, "wall.inside", static_cast<std::uint32_t>(plant)) == 0);
    }
    CHECK(nearest > 0);
    CHECK(farthest < 0.15);
    CHECK(shed > 1000);
}

TEST_CASE("three processes at once: roots stay in the pot and drink it, the shoot shades itself", "[processes]") {
    const std::string file = "environments/pot.toml";
    const auto pot = shape_of(file, "pot");
    const auto world = grown(file);
    auto symbols = counts(*world, 0);

    // The pot holds the roots, also where they lie along its wall.
    double outermost = -1;
    int below = 0, along_wall = 0;
    for (const Internode& internode : world->interpretation(0).geometry.internodes) {
        if (internode.tip.y >= 0) continue;
        ++below;
        const double distance = pot->distance(internode.tip);
        outermost = std::max(outermost, distance);
        along_wall += distance > -0.01 ? 1 : 0;
    }
    CHECK(below > 500);
    CHECK(along_wall > 100);
    CHECK(outermost <= 0);
    CHECK(statistic(*world, "pot.outside") == 0);

    // What is missing in the soil is what the roots drank.
    const auto filled = grown(file, {{}, 0, {}});
    const double at_first = statistic(*filled, "water.total") + statistic(*filled, "water.drunk");
    CHECK(statistic(*world, "water.drunk") > 100);
    CHECK(statistic(*world, "water.total") + statistic(*world, "water.drunk") == Approx(at_first).epsilon(1e-9));
    CHECK(std::abs(statistic(*world, "water.balance")) < 1e-9);
    CHECK(statistic(*world, "water.minimum") >= 0);

    // The lamp: leaves below others have less.
    CHECK(statistic(*world, "light.max") > 0.95);
    CHECK(statistic(*world, "light.mean") < 0.9);
    CHECK(statistic(*world, "light.casts") == symbols["L"]);
}

TEST_CASE("three processes at once: each matters to its own part of the plant only", "[processes]") {
    const std::string file = "environments/pot.toml";
    const auto as_it_is = grown(file);
    const auto unshaded = grown(file, {{{"plant.0.define.SHADOW", "0"}}, {}, {}});
    const auto dry = grown(file, {{{"environment.water.initial", "0"}}, {}, {}});
    const auto lies_below = [](const World& world) {
        const auto& internodes = world.interpretation(0).geometry.internodes;
        return std::count_if(internodes.begin(), internodes.end(), [](auto& internode) { return internode.tip.y < 0; });
    };
    CHECK(lies_below(*unshaded) == lies_below(*as_it_is));
    CHECK(counts(*unshaded, 0)["L"] > counts(*as_it_is, 0)["L"]);
    CHECK(lies_below(*dry) == 1);  // the crown
    CHECK(counts(*dry, 0)["L"] == counts(*as_it_is, 0)["L"]);
}
