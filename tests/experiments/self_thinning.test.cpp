// Plants that crowd each other out under Beer's law and under paths of light: Yoda's law of -3/2.
#include "catch.h"
#include "experiments/growth.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace espalier;

namespace {

struct Stand {
    double density = 0, mean_mass = 0, leaf_area_index = 0;
    std::vector<int> of_species;
};

constexpr double ground = 1.8 * 1.8;

Stand state_of(const World& world) {
    Stand stand;
    stand.of_species.assign(3, 0);
    for (std::size_t plant = 0; plant < world.size(); ++plant) {
        const ModuleString& string = world.string(plant);
        const auto letter = world.model(plant).alphabet.find("P", 1);
        const std::vector<std::size_t> offsets = parameter_offsets(string, world.model(plant).alphabet);
        for (std::size_t i = 0; i < string.size(); ++i) {
            if (string.letters[i] != *letter) continue;
            const double size = string.parameters[offsets[i]];
            stand.density += 1 / ground;
            stand.mean_mass += size * size * size;
            stand.leaf_area_index += 0.6 * size * size / ground;
            ++stand.of_species[3 * plant / world.size()];
        }
    }
    stand.mean_mass /= stand.density * ground;
    return stand;
}

std::vector<Stand> history(std::uint64_t seed, int steps, const std::string& light = "") {
    SceneOptions options;
    options.steps = steps;
    options.overrides = {{"simulation.seed", std::to_string(seed)}};
    if (!light.empty()) options.overrides.emplace_back("environment.light", light);
    World world(read_scene(source_path("environments/crowded-stand.toml"), options));
    world.start();
    std::vector<Stand> states{state_of(world)};
    while (!world.at_end()) {
        world.step();
        states.push_back(state_of(world));
    }
    return states;
}

/// Least squares of log mean mass over log density, from where half of the plants have died until 25 are left.
double slope(const std::vector<Stand>& states) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Stand& stand : states) {
        if (stand.density > 0.5 * states.front().density || stand.density * ground < 25) continue;
        const double a = std::log(stand.density), b = std::log(stand.mean_mass);
        n += 1;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

void check_thinning(const std::string& name, const std::vector<Stand>& states) {
    const Stand &first = states.front(), &last = states.back();
    UNSCOPED_INFO(name << ": slope " << slope(states) << "; " << first.density * ground << " plants become "
                       << last.density * ground << ", of the species " << last.of_species[0] << ", "
                       << last.of_species[1] << ", " << last.of_species[2] << "; leaf area index "
                       << last.leaf_area_index);
    CHECK(slope(states) == Approx(-1.5).margin(0.1));
    CHECK(last.density < 0.3 * first.density);
    CHECK(std::is_sorted(states.rbegin(), states.rend(),
                         [](const Stand& a, const Stand& b) { return a.density < b.density; }));
}

}  // namespace

TEST_CASE("a crowd of three species thins itself along the line of -3/2, in voxels and by paths of light",
          "[self-thinning]") {
    check_thinning("canopy-light", history(11, 60));
    for (const std::uint64_t seed : {12, 13}) {
        check_thinning("ray-light", history(seed, 48,
                                            "{ process = \"ray-light\", paths = 16384, periodic = true, sky = { par = "
                                            "1000, diffuse = 1 }, bands = { par = { leaf = [0, 0], stem = 0, soil = 0 "
                                            "} } }"));
    }
}

TEST_CASE("plants that stand 1.5 m apart do not thin", "[self-thinning]") {
    SceneOptions options;
    options.steps = 48;
    options.overrides = {{"environment.light.periodic", "false"}, {"environment.light.voxel", "0.1"}};
    for (const int species : {0, 1, 2}) {
        const std::string table = "plant." + std::to_string(species);
        options.overrides.emplace_back(table + ".position", "[" + std::to_string(3 * (species - 1)) + ", 0, 0]");
        options.overrides.emplace_back(table + ".grid", "{ columns = 2, rows = 2, spacing = 1.5 }");
    }
    const auto world = grown("environments/crowded-stand.toml", options);
    const Stand stand = state_of(*world);
    CHECK(stand.density * ground == Approx(12));
    CHECK(stand.mean_mass > 0.2);
}
