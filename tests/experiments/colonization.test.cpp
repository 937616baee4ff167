// Space colonization as an open L-system: its nodes are those of the algorithm written down plainly.
#include "catch.h"
#include "environment/space/markers/cloud.h"
#include "experiments/growth.h"
#include "turtle/internode_bearers.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

using namespace espalier;

namespace {

struct Rules {
    double influence = 1, kill = 0.4, step = 0.2, cosine = -1;
    glm::dvec3 tropism{0, 0.1, 0};
};

struct Node {
    glm::dvec3 position{0}, heading{0, 1, 0}, last{0};
};

/// Runions, Lane & Prusinkiewicz 2007, section 2: every point asks every node.
std::vector<Node> colonized(std::vector<glm::dvec3> points, const Rules& rules, int iterations) {
    std::vector<Node> nodes{{}};
    for (int i = 0; i < iterations; ++i) {
        std::erase_if(points, [&](const glm::dvec3& point) {
            return std::any_of(nodes.begin(), nodes.end(),
                               [&](const Node& node) { return glm::distance(node.position, point) <= rules.kill; });
        });
        std::vector<glm::dvec3> pull(nodes.size(), glm::dvec3(0));
        for (const glm::dvec3& point : points) {
            const auto nearest = std::min_element(nodes.begin(), nodes.end(), [&](const Node& a, const Node& b) {
                return glm::distance(a.position, point) < glm::distance(b.position, point);
            });
            const glm::dvec3 towards = point - nearest->position;
            const double distance = glm::length(towards);
            if (distance > rules.influence || glm::dot(nearest->heading, towards) < rules.cosine * distance) continue;
            pull[static_cast<std::size_t>(nearest - nodes.begin())] += towards / distance;
        }
        for (std::size_t k = 0; k < pull.size(); ++k) {
            if (glm::length(pull[k]) < 1e-9) continue;
            const glm::dvec3 direction = glm::normalize(glm::normalize(pull[k]) + rules.tropism);
            if (glm::distance(direction, nodes[k].last) < 1e-6) continue;
            nodes[k].last = direction;
            nodes.push_back({nodes[k].position + rules.step * direction, direction});
        }
    }
    return nodes;
}

std::vector<glm::dvec3> sorted(std::vector<glm::dvec3> points) {
    std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z);
    });
    return points;
}

std::string scene_text(const Rules& rules, const std::string& cloud, int steps) {
    return fmt::format(
        "[simulation]\nsteps = {}\nseed = 3\n[[plant]]\nmodel = 'models/colonization/tree.l'\n"
        "define = {{ NODE_DISTANCE = {}, GNARLY = 0, LEAST_TURN = 0 }}\n[environment.markers]\nprocess = 'markers'\n"
        "influence = {}\nkill = {}\nperception = {}\ntropism = [0, {}, 0]\n{}\n",
        steps, rules.step, rules.influence, rules.kill,
        rules.cosine <= -1 ? 360 : 2 * glm::degrees(std::acos(rules.cosine)), rules.tropism.y, cloud);
}

}  // namespace

TEST_CASE("the L-system's nodes are those of the algorithm, one by one", "[colonization]") {
    const std::string cloud = "cloud = { radii = [1.5, 1.5, 1.5], base = [0, 0.3, 0], number = 800, seed = 2 }";
    environment::EnvironmentContext context;
    context.seed = 3;
    const auto points = environment::read_clouds(Settings::parse_toml(cloud, "cloud"), context, 1000000);
    for (const Rules& rules : {Rules{}, Rules{0.7, 0.3, 0.15, std::cos(glm::radians(80.0))}}) {
        World world(read_scene_text(scene_text(rules, cloud, 25), "scene.toml", source_path("")));
        world.start();
        while (!world.at_end()) world.step();
        std::vector<glm::dvec3> grown{{0, 0, 0}}, expected;
        for (const Internode& internode : world.interpretation(0).geometry.internodes) grown.push_back(internode.tip);
        for (const Node& node : colonized(points, rules, 25)) expected.push_back(node.position);
        REQUIRE(grown.size() == expected.size());
        CHECK(grown.size() > 200);
        grown = sorted(grown);
        expected = sorted(expected);
        for (std::size_t i = 0; i < grown.size(); ++i) REQUIRE(glm::distance(grown[i], expected[i]) < 1e-9);
    }
}

namespace {

const char* const crown = "cloud = { radii = [1.5, 1.5, 1.5], base = [0, 0.3, 0], density = 120 }";

World grown_scene(const std::string& scene) {
    World world(read_scene_text(scene, "scene.toml", source_path("")));
    world.start();
    while (!world.at_end()) world.step();
    return world;
}

std::vector<glm::dvec3> tips(const World& world, std::size_t plant = 0) {
    std::vector<glm::dvec3> tips;
    for (const Internode& internode : world.interpretation(plant).geometry.internodes) tips.push_back(internode.tip);
    return tips;
}

std::vector<std::uint32_t> bearers(const World& world) {
    return internode_bearers(world.interpretation(0).geometry, world.string(0));
}

std::size_t ends(const World& world) {
    std::vector<char> bears(tips(world).size(), 0);
    for (const std::uint32_t bearer : bearers(world)) {
        if (bearer != turtle::no_bearer) bears[bearer] = 1;
    }
    return static_cast<std::size_t>(std::count(bears.begin(), bears.end(), 0));
}

/// The way along ten internodes of an axis, and the straight one: the mean of their ratio.
double tortuosity(const World& world) {
    constexpr int pieces = 10;
    const auto& internodes = world.interpretation(0).geometry.internodes;
    const std::vector<std::uint32_t> on = bearers(world);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < internodes.size(); ++i) {
        std::uint32_t first = static_cast<std::uint32_t>(i);
        int passed = 1;
        while (passed < pieces && on[first] != turtle::no_bearer && internodes[on[first]].axis == internodes[i].axis) {
            first = on[first];
            ++passed;
        }
        if (passed < pieces) continue;
        const double way = pieces * glm::distance(internodes[i].base, internodes[i].tip);
        sum += way / std::max(glm::distance(internodes[first].base, internodes[i].tip), 0.1 * way);
        ++count;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

TEST_CASE("the farther points are removed, the fewer ends the tree has", "[colonization]") {
    std::size_t before = 1000000;
    for (const double kill : {0.2, 0.3, 0.5, 0.8}) {
        const std::size_t now = ends(grown_scene(scene_text({1, kill, 0.15}, crown, 30)));
        CHECK(now < before);
        before = now;
    }
}

TEST_CASE("the farther points attract, the straighter the branches", "[colonization]") {
    double before = 0;
    for (const double influence : {1.5, 0.7, 0.5, 0.42}) {
        const double now = tortuosity(grown_scene(scene_text({influence, 0.25, 0.1}, crown, 60)));
        CHECK(now > before);
        before = now;
    }
}

TEST_CASE("every internode has the length D, and the tree of an age is the beginning of an older one",
          "[colonization]") {
    const World younger = grown_scene(scene_text({}, crown, 15)), older = grown_scene(scene_text({}, crown, 25));
    for (const Internode& internode : older.interpretation(0).geometry.internodes) {
        REQUIRE(glm::distance(internode.base, internode.tip) == Approx(0.2));
    }
    const auto all = sorted(tips(older)), some = sorted(tips(younger));
    CHECK(all.size() > some.size());
    for (const glm::dvec3& tip : some) {
        REQUIRE(std::any_of(all.begin(), all.end(), [&](const glm::dvec3& other) { return other == tip; }));
    }
}

TEST_CASE("no internode turns from its bearer by more than half the angle of perception", "[colonization]") {
    const World world = grown_scene(scene_text({1, 0.3, 0.2, std::cos(glm::radians(45.0)), glm::dvec3(0)}, crown, 30));
    const auto& internodes = world.interpretation(0).geometry.internodes;
    const std::vector<std::uint32_t> on = bearers(world);
    for (std::size_t i = 0; i < on.size(); ++i) {
        if (on[i] == turtle::no_bearer) continue;
        const glm::dvec3 along = internodes[i].tip - internodes[i].base;
        const glm::dvec3 before = internodes[on[i]].tip - internodes[on[i]].base;
        REQUIRE(glm::dot(glm::normalize(along), glm::normalize(before)) >= std::cos(glm::radians(45.0)) - 1e-9);
    }
}

TEST_CASE("two plants compete: together they have the space that each would have alone", "[colonization]") {
    const auto scene = [](const std::string& places) {
        return "[simulation]\nsteps = 40\n[[plant]]\nmodel = 'models/colonization/tree.l'\npositions = " + places +
               "\ndefine = { NODE_DISTANCE = 0.2, GNARLY = 0, LEAST_TURN = 0 }\n[environment.markers]\nprocess = "
               "'markers'\ninfluence = 1\n"
               "kill = 0.4\ncloud = { radii = [2, 1, 2], number = 3000 }\n";
    };
    const World both = grown_scene(scene("[[-1, 0, 0], [1, 0, 0]]")), left = grown_scene(scene("[[-1, 0, 0]]"));
    const std::size_t together = tips(both, 0).size() + tips(both, 1).size(), alone = tips(left).size();
    CHECK(tips(both, 0).size() < 0.75 * static_cast<double>(alone));
    CHECK(static_cast<double>(together) == Approx(static_cast<double>(alone)).epsilon(0.2));
    for (const glm::dvec3& a : tips(both, 0)) {
        for (const glm::dvec3& b : tips(both, 1)) REQUIRE(glm::distance(a, b) > 0.05);
    }
}

namespace {

World organized(const std::map<std::string, double>& settings, double lambda, int years) {
    SceneOptions options;
    options.steps = 2 * years;
    for (const auto& [name, value] : settings) {
        options.overrides.emplace_back("plant.0.define." + name, std::to_string(value));
    }
    options.overrides.emplace_back("environment.resource.lambda", std::to_string(lambda));
    World world(read_scene(source_path("environments/self-organizing.toml"), options));
    world.start();
    while (!world.at_end()) world.step();
    return world;
}

/// Returns the share of the main axis in the length of all internodes.
double share_of_trunk(const World& world) {
    double trunk = 0;
    for (const Internode& internode : world.interpretation(0).geometry.internodes) {
        if (internode.order == 0) trunk += glm::distance(internode.base, internode.tip);
    }
    return trunk / total_length(world.interpretation(0).geometry);
}

}  // namespace

TEST_CASE("a self-organizing tree has the more of a trunk the larger lambda is", "[colonization]") {
    double before = 0;
    for (const double lambda : {0.42, 0.5, 0.54, 0.6}) {
        const double now = share_of_trunk(organized({}, lambda, 10));
        CHECK(now > before);
        before = now;
    }
}

TEST_CASE("the higher the limit of shedding, the fewer internodes a self-organizing tree keeps", "[colonization]") {
    std::size_t before = 1000000;
    for (const double limit : {0.0, 0.12, 0.16, 0.2}) {
        const std::size_t now = tips(organized({{"SHED_BELOW", limit}}, 0.5, 12)).size();
        CHECK(now < before);
        before = now;
    }
}

TEST_CASE("buds that need light leave the shade below: the tree without it has more internodes", "[colonization]") {
    CHECK(tips(organized({{"LIGHT", 0}}, 0.5, 12)).size() > tips(organized({}, 0.5, 12)).size());
}

namespace {

std::unique_ptr<World> tree(const std::map<std::string, double>& settings, std::uint64_t seed = 0) {
    SceneOptions options;
    options.seed = seed;
    for (const auto& [name, value] : settings) {
        options.overrides.emplace_back("plant.0.define." + name, std::to_string(value));
    }
    return grown("environments/tree.toml", options);
}

}  // namespace

TEST_CASE("a crown lies in its cloud, and its height and width are those of the cloud", "[colonization]") {
    for (const double height : {3.0, 6.0}) {
        double ratios = 0;
        for (const std::uint64_t seed : {0, 1, 2, 3}) {
            const auto world = tree({{"CROWN_WIDTH", 4},
                                     {"CROWN_DEPTH", 4},
                                     {"CROWN_HEIGHT", height},
                                     {"CUT_BELOW", 0.2},
                                     {"RAGGED", 0},
                                     {"UPWARDS", 0.1},
                                     {"AXIS_INTERNODES", 400},
                                     {"AGE", 70}},
                                    seed);
            Box box;
            for (const glm::dvec3& tip : tips(*world)) {
                const glm::dvec3 from_centre = tip - glm::dvec3(0, height * (0.5 - 0.2), 0);
                const glm::dvec3 reach = glm::dvec3(2, height / 2, 2) + 0.15;
                REQUIRE(glm::length(from_centre / reach) <= 1);
                box.add(tip);
            }
            const double ratio = box.upper.y / (box.upper.x - box.lower.x);
            CHECK(ratio == Approx(0.8 * height / 4).epsilon(0.1));
            ratios += ratio / 4;
        }
        CHECK(ratios == Approx(0.8 * height / 4).epsilon(0.05));
    }
}

namespace {

/// Returns by how much internodes of the trunk are thicker than what reaches their height; the least.
double least_lead(const std::map<std::string, double>& settings, std::uint64_t seed) {
    const auto world = tree(settings, seed);
    const Frame frame = world->frame();
    const auto& internodes = frame.plants[0].interpretation->geometry.internodes;
    double least = 1000, top = 0;
    for (const Internode& part : internodes) {
        if (part.order > 0) continue;
        top = part.tip.y;
        for (const Internode& one : internodes) {
            const bool beside = one.order > 0 && one.tip.y > part.base.y && one.base.y < part.tip.y;
            if (beside) least = std::min(least, part.tip_radius / one.tip_radius);
        }
    }
    const auto height = settings.count("CROWN_HEIGHT") ? settings.at("CROWN_HEIGHT") : 7.0;
    const auto below = settings.count("CUT_BELOW") ? settings.at("CUT_BELOW") : 0.1;
    CHECK(top > (1 - below) * height - 0.2);
    return least;
}

}  // namespace

TEST_CASE("a trunk through the whole crown ends at its top and is the thickest axis at every height",
          "[colonization]") {
    const std::map<std::string, double> bare{{"TRUNK_IN_CROWN", 1}, {"LEAVES", 0}, {"STEM_LENGTH", 0}, {"ROOTS", 0}};
    const auto with = [&](std::map<std::string, double> more) {
        more.insert(bare.begin(), bare.end());
        return more;
    };
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CHECK(least_lead(bare, seed) > 1);
        CHECK(least_lead(with({{"CROWN_HEIGHT", 12}, {"CUT_BELOW", 0.5}}), seed) > 1);
        CHECK(least_lead(with({{"CROWN_HEIGHT", 3}, {"CROWN_WIDTH", 8}, {"GNARLY", 1}}), seed) > 1);
    }
}

TEST_CASE("the setting `gnarly` makes branches wind more and more, and hardly changes how densely they branch",
          "[colonization]") {
    for (const auto& crown : {std::array{7.0, 7.0}, {9.0, 3.0}, {3.0, 9.0}}) {
        double before = 0, straight = 0;
        for (const double gnarly : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            double now = 0, internodes = 0;
            for (std::uint64_t seed = 1; seed <= 4; ++seed) {
                const auto world = tree({{"GNARLY", gnarly},
                                         {"CROWN_WIDTH", crown[0]},
                                         {"CROWN_DEPTH", crown[0]},
                                         {"CROWN_HEIGHT", crown[1]}},
                                        seed);
                now += tortuosity(*world);
                internodes += static_cast<double>(tips(*world).size());
            }
            INFO(crown[0] << " m wide, gnarly " << gnarly << ": " << now / 4 << ", " << internodes / 4);
            CHECK(now > before);
            before = now;
            if (gnarly == 0) straight = internodes;
            CHECK(internodes > 0.75 * straight);
            CHECK(internodes < 1.4 * straight);
        }
    }
}

TEST_CASE("winding trees have about as many tips as straight ones, young or when their crown is full",
          "[colonization]") {
    for (const int age : {30, 80}) {
        for (const auto& crown : {std::array{6.0, 6.0}, {8.0, 3.0}, {3.0, 8.0}}) {
            double straight = 0;
            for (const double gnarly : {0.0, 0.5, 1.0}) {
                double tips = 0;
                for (std::uint64_t seed = 11; seed <= 13; ++seed) {
                    tips += static_cast<double>(ends(*tree({{"GNARLY", gnarly},
                                                            {"AGE", age},
                                                            {"LEAVES", 0},
                                                            {"CROWN_WIDTH", crown[0]},
                                                            {"CROWN_DEPTH", crown[0]},
                                                            {"CROWN_HEIGHT", crown[1]}},
                                                           seed)));
                }
                INFO(age << " steps, " << crown[0] << " m wide, gnarly " << gnarly << ": " << tips / 3);
                if (gnarly == 0) straight = tips;
                CHECK(tips > 0.7 * straight);
                CHECK(tips < 1.4 * straight);
            }
        }
    }
}

TEST_CASE("the roots of the root flare stay below the ground, and its crown above", "[colonization]") {
    const auto world = grown("environments/root-flare.toml");
    for (const glm::dvec3& tip : tips(*world, 0)) REQUIRE(tip.y > 0);
    for (const glm::dvec3& tip : tips(*world, 1)) REQUIRE(tip.y < 0);
    CHECK(tips(*world, 1).size() > 50);
}
