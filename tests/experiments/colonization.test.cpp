// Space colonization as an open L-system: its nodes are those of the algorithm written down plainly.
#include "catch.h"
#include "environment/markers/cloud.h"
#include "experiments/growth.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
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
        "define = {{ NODE_DISTANCE = {} }}\n[environment.markers]\nprocess = 'markers'\n"
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
