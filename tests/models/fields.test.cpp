// Models that grow in fields: Cohen's patterns, forks between attractors and inhibitors, Greene's vines, climbers.
#include "espalier/environment/shape.h"

#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <map>

using namespace espalier;

namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

std::unique_ptr<World> grown_with(const std::string& scene, const Overrides& overrides) {
    SceneOptions options;
    options.overrides = overrides;
    return grown(scene, options);
}

glm::dvec3 centre_of(const World& world) {
    glm::dvec3 sum(0);
    const auto& internodes = world.interpretation(0).geometry.internodes;
    for (const Internode& internode : internodes) sum += internode.tip;
    return sum / static_cast<double>(internodes.size());
}

}  // namespace

TEST_CASE("cohen: every fork keeps its distance from the one before it on its axis", "[fields]") {
    const auto world = grown_with("environments/cohen.toml", {});
    const auto forks = parameters_of(world->string(0), world->model(0).alphabet, "K");
    REQUIRE(forks.size() > 50);
    int too_near = 0;
    for (const auto& fork : forks) too_near += fork[0] < 0.35;
    CHECK(too_near == 0);
    const auto closer = grown_with("environments/cohen.toml", {{"environment.field.fork_distance", "0.1"}});
    CHECK(parameters_of(closer->string(0), closer->model(0).alphabet, "K").size() > forks.size());
}

TEST_CASE("cohen: laterals begin at the angle of their order; without forks the axis is straight", "[fields]") {
    const auto world = grown_with("environments/cohen.toml", {});
    const auto& internodes = world->interpretation(0).geometry.internodes;
    for (std::size_t i = 0; i < internodes.size(); ++i) {
        if (internodes[i].order == 0) CHECK(std::abs(internodes[i].tip.z) < 1e-9);  // in the plane
    }
    const auto children = children_of(world->interpretation(0).geometry);
    int wrong = 0, laterals = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
        for (const std::size_t child : children[i]) {
            if (internodes[child].order == internodes[i].order) continue;
            const double angle = 50 * std::pow(0.85, internodes[i].order);
            wrong +=
                std::abs(degrees_between(direction_of(internodes[i]), direction_of(internodes[child])) - angle) > 1e-6;
            ++laterals;
        }
    }
    CHECK(wrong == 0);
    CHECK(laterals > 50);

    const auto lone = grown_with("environments/cohen.toml", {{"environment.field.branching", "0"}});
    CHECK(lone->interpretation(0).geometry.internodes.size() == 60);
    for (const Internode& internode : lone->interpretation(0).geometry.internodes) {
        CHECK(degrees_between(direction_of(internode), {0, 1, 0}) < 1e-6);
    }
}

TEST_CASE("cohen: growth strives up with a tropism", "[fields]") {
    const auto mean_height = [](const World& world) {
        double sum = 0;
        const auto& internodes = world.interpretation(0).geometry.internodes;
        for (const Internode& internode : internodes) sum += direction_of(internode).y;
        return sum / static_cast<double>(internodes.size());
    };
    CHECK(mean_height(*grown_with("environments/cohen-vertical.toml", {})) > 0.7);
    CHECK(mean_height(*grown_with("environments/cohen.toml", {})) < 0.3);
}

TEST_CASE("cohen: the pattern leans to the attractor and away from the inhibitor", "[fields]") {
    const char* const scene = "environments/cohen-sources.toml";
    const std::pair<std::string, std::string> no_attraction{"environment.field.attraction", "0"};
    const std::pair<std::string, std::string> no_inhibition{"environment.field.inhibition", "0"};
    const glm::dvec3 attractor(2.5, 1.5, 0), inhibitor(-0.4, 2, 0);
    const auto neither = grown_with(scene, {no_attraction, no_inhibition});
    const auto attracted = grown_with(scene, {no_inhibition}), inhibited = grown_with(scene, {no_attraction});
    const glm::dvec3 centre = centre_of(*neither);
    CHECK(glm::distance(centre_of(*attracted), attractor) < glm::distance(centre, attractor));
    CHECK(glm::distance(centre_of(*inhibited), inhibitor) > glm::distance(centre, inhibitor));
}

TEST_CASE("aono-kunii-field: forks have the angle and the ratio of their order", "[fields]") {
    const auto world = grown_with("environments/aono-kunii-field.toml", {});
    const PlantGeometry& geometry = world->interpretation(0).geometry;
    const auto children = children_of(geometry);
    std::vector<int> forks_below(children.size(), 0);
    int wrong = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (children[i].empty()) continue;
        REQUIRE(children[i].size() == 2);
        const Internode &a = geometry.internodes[children[i][0]], &b = geometry.internodes[children[i][1]];
        const double angle = 2 * 36 * std::pow(0.94, forks_below[i]);
        wrong += std::abs(degrees_between(direction_of(a), direction_of(b)) - angle) > 1e-6;
        for (const std::size_t child : children[i]) {
            forks_below[child] = forks_below[i] + 1;
            wrong += std::abs(length_of(geometry.internodes[child]) / length_of(geometry.internodes[i]) - 0.84) > 1e-9;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("aono-kunii-field: the sources bend the tree to their sides", "[fields]") {
    const char* const scene = "environments/aono-kunii-field.toml";
    const std::pair<std::string, std::string> no_attraction{"environment.field.attraction", "0"};
    const std::pair<std::string, std::string> no_inhibition{"environment.field.inhibition", "0"};
    const double alone = centre_of(*grown_with(scene, {no_attraction, no_inhibition})).x;
    CHECK(centre_of(*grown_with(scene, {no_inhibition})).x > alone + 0.5);  // attractor at +x
    CHECK(centre_of(*grown_with(scene, {no_attraction})).x > alone + 0.5);  // inhibitor at -x
}

TEST_CASE("vines: segments, forks and leaves are as set, near the house and never in it", "[fields]") {
    SceneOptions options;
    options.steps = 14;
    const auto world = grown("environments/vines.toml", options);
    Settings table{{"shape", "mesh"}, {"file", source_path("environments/meshes/house.obj")}, {"voxel", 0.05}};
    const auto house = read_shape(table);
    std::size_t nodes = 0;
    int wrong = 0;
    for (std::size_t plant = 0; plant < 8; ++plant) {
        const PlantGeometry& geometry = world->interpretation(plant).geometry;
        nodes += geometry.internodes.size();
        for (const Internode& internode : geometry.internodes) {
            const double distance = house->distance(internode.tip);
            const glm::dvec3 voxel = (glm::floor(internode.tip / 0.1) + 0.5) * 0.1;
            wrong += distance < 0.01 - 1e-9 || distance > 0.15 + 1e-9 || house->inside(voxel);
            wrong += length_of(internode) < 0.08 - 1e-9 || length_of(internode) > 0.14 + 1e-9;
        }
        CHECK(geometry.polygons.size() ==
              2 * parameters_of(world->string(plant), world->model(plant).alphabet, "L").size());
    }
    CHECK(nodes > 200);
    CHECK(wrong == 0);
}

TEST_CASE("vines: tips choose the lighter trials, and live in more light than vines that are blind to it", "[fields]") {
    // Mean exposures of the trials taken, and of those allowed but not taken.
    const auto exposures = [](const char* light, std::uint64_t seed) {
        SceneOptions options;
        options.overrides = {{"environment.vine.weights.light", light}};
        options.seed = seed;
        World world(read_scene(source_path("environments/vines.toml"), options));
        world.start();
        double chosen = 0, rejected = 0, grown = 0;
        for (int step = 0; step < 20; ++step) {
            world.step();
            for (std::uint32_t plant = 0; plant < 8; ++plant) {
                std::map<std::string, double> of;
                for (const Quantity& each : world.environment().statistics(plant)) of[each.name] = each.value;
                if (!(of["vine.grown"] > 0) || std::isnan(of["vine.rejected"])) continue;  // all trials were taken
                chosen += of["vine.grown"] * of["vine.chosen"];
                rejected += of["vine.grown"] * of["vine.rejected"];
                grown += of["vine.grown"];
            }
        }
        return std::pair(chosen / grown, rejected / grown);
    };
    for (const std::uint64_t seed : {11u, 12u, 13u}) {
        const auto [chosen, rejected] = exposures("4", seed);
        const auto [blind, blind_rejected] = exposures("0", seed);
        CHECK(chosen > rejected + 0.005);
        CHECK(blind < blind_rejected + 0.005);
        CHECK(chosen > blind + 0.02);
    }
}

TEST_CASE("vines: an axis forks after every fourth node", "[fields]") {
    SceneOptions options;
    options.steps = 14;
    const auto world = grown("environments/vines.toml", options);
    const PlantGeometry& geometry = world->interpretation(0).geometry;
    const auto children = children_of(geometry);
    std::vector<int> since_fork(children.size(), 1);
    int wrong = 0, forks = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
        // A lateral that found no room leaves no fork to be seen.
        if (children[i].size() == 2) {
            wrong += since_fork[i] % 4 != 0;
            ++forks;
        }
        for (const std::size_t child : children[i]) {
            const bool lateral = geometry.internodes[child].order != geometry.internodes[i].order;
            since_fork[child] = lateral ? 1 : since_fork[i] + 1;
        }
    }
    CHECK(forks > 3);
    CHECK(wrong == 0);
}

TEST_CASE("climber: shoots wind around the column, not farther than their distance and never through it", "[fields]") {
    const auto world = grown("environments/climber.toml");
    Settings table = Settings::read_toml(source_path("environments/climber.toml")).table("environment").table("column");
    const auto column = read_shape(table);
    int wrong = 0;
    double turned = 0, highest = 0;
    for (const Internode& internode : world->interpretation(0).geometry.internodes) {
        // Less in the corner between dish and ball, where another surface is near.
        wrong += column->distance(internode.tip) > 0.02 + 1e-4 || column->distance(internode.tip) <= 0;
        for (int k = 1; k < 8; ++k) wrong += column->inside(glm::mix(internode.base, internode.tip, k / 8.0));
        highest = std::max(highest, internode.tip.y);
        if (internode.order > 0 || internode.tip.y > 1.9) continue;
        turned += std::remainder(
            std::atan2(internode.tip.z, internode.tip.x) - std::atan2(internode.base.z, internode.base.x),
            2 * std::numbers::pi);
    }
    CHECK(wrong == 0);
    CHECK(std::abs(turned) > 2 * std::numbers::pi);
    CHECK(highest > 2.5);
}
