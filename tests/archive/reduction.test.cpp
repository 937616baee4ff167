// Fewer triangles of a tree: what bears the others stays where it stands.
#include "archive/meshes/reduction.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace espalier::archive;

namespace {

/// Follows `points`, evenly tapered.
PlannedTube tube(const std::vector<glm::vec3>& points, float radius, bool stands_free) {
    PlannedTube planned{{}, 8, Caps::round, 0};
    planned.line.stands_free = stands_free;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float part = 1 - 0.9f * static_cast<float>(i) / static_cast<float>(points.size());
        planned.line.nodes.push_back({points[i], radius * part, espalier::PointIndex(0)});
    }
    return planned;
}

/// All nodes of the tubes here stand for this one point.
espalier::FrameAttributes of_one_point() {
    espalier::FrameAttributes attributes;
    attributes.colours.assign(1, 0);
    attributes.plants.assign(1, 0);
    return attributes;
}

constexpr int trunk_nodes = 30;

/// A point of a trunk that bends like a bow: its middle stands far from the line between foot and tip.
glm::vec3 on_trunk(int i) {
    const float height = 0.3f * static_cast<float>(i);
    return {0.08f * height * (9 - height), height, 0};
}

/// The trunk, twenty branches on it, ten twigs on each.
std::vector<PlannedTube> tree() {
    std::vector<glm::vec3> trunk;
    for (int i = 0; i < trunk_nodes; ++i) trunk.push_back(on_trunk(i));
    std::vector<PlannedTube> tubes{tube(trunk, 0.2f, true)};
    for (int i = 5; i < 25; ++i) {
        const float angle = 2.4f * static_cast<float>(i);
        const glm::vec3 out(std::cos(angle), 0.4f, std::sin(angle));
        std::vector<glm::vec3> branch;
        for (int k = 0; k <= 10; ++k) branch.push_back(on_trunk(i) + 0.25f * static_cast<float>(k) * out);
        tubes.push_back(tube(branch, 0.06f, false));
        for (int k = 1; k <= 10; ++k) {
            const glm::vec3 from = branch[static_cast<std::size_t>(k)];
            tubes.push_back(tube({from, from + glm::vec3(0, 0.3f, 0.1f), from + glm::vec3(0, 0.6f, 0)}, 0.01f, false));
        }
    }
    return tubes;
}

double distance_to(const TubeLine& line, const glm::vec3& point) {
    double nearest = 1e9;
    for (std::size_t i = 1; i < line.nodes.size(); ++i) {
        const glm::vec3 a = line.nodes[i - 1].position, along = line.nodes[i].position - a;
        const float share = std::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0f, 1.0f);
        nearest = std::min(nearest, double(glm::distance(a + share * along, point)));
    }
    return nearest;
}

std::size_t triangles_of(const std::vector<PlannedTube>& tubes) {
    std::size_t count = 0;
    for (const PlannedTube& one : tubes) {
        if (one.sides > 0) count += swept_triangles(one.line.nodes.size(), one.sides, one.caps);
    }
    return count;
}

}  // namespace

TEST_CASE("a trunk keeps its foot and its course however few triangles are left", "[archive]") {
    const espalier::FrameAttributes of_points = of_one_point();
    const std::vector<PlannedTube> whole = tree();
    for (const std::size_t wanted : {8000, 2000, 777, 300}) {
        INFO(wanted);
        std::vector<PlannedTube> tubes = whole;
        espalier::archive::FrameMesh organs;
        reduce(tubes, organs, of_points, wanted);
        CHECK(triangles_of(tubes) <= wanted);
        CHECK(triangles_of(tubes) > 9 * wanted / 10);
        const TubeLine& trunk = tubes.front().line;
        REQUIRE(tubes.front().sides >= 3);
        CHECK(trunk.nodes.front().position == on_trunk(0));
        // Within the trunk's own wood.
        for (int i = 0; i < trunk_nodes; ++i) CHECK(distance_to(trunk, on_trunk(i)) < 0.1);
    }
}

TEST_CASE("what bears others goes after them", "[archive]") {
    const espalier::FrameAttributes of_points = of_one_point();
    std::vector<PlannedTube> tubes = tree();
    espalier::archive::FrameMesh organs;
    reduce(tubes, organs, of_points, 600);
    // The branch of a twig that is left is left.
    for (std::size_t branch = 1; branch < tubes.size(); branch += 11) {
        for (std::size_t twig = 1; twig <= 10; ++twig) {
            if (tubes[branch + twig].sides > 0) CHECK(tubes[branch].sides > 0);
        }
    }
}

TEST_CASE("half of the triangles of smooth branches leave all of them in their wood", "[archive]") {
    const espalier::FrameAttributes of_points = of_one_point();
    std::vector<PlannedTube> whole;
    for (int i = 0; i < 60; ++i) {
        std::vector<glm::vec3> twig;
        const float turn = 2.4f * static_cast<float>(i), bend = 0.05f + 0.002f * static_cast<float>(i);
        for (int k = 0; k <= 16; ++k) {
            const float part = static_cast<float>(k) / 16;
            const float aside = bend * std::sin(3.1416f * part);
            twig.push_back({aside * std::cos(turn), 0.6f * part + static_cast<float>(i), aside * std::sin(turn)});
        }
        whole.push_back(tube(twig, 0.01f, true));
        whole.back().sides = 3;
    }
    std::vector<PlannedTube> tubes = whole;
    espalier::archive::FrameMesh organs;
    reduce(tubes, organs, of_points, triangles_of(whole) / 2);
    CHECK(triangles_of(tubes) <= triangles_of(whole) / 2);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        REQUIRE(tubes[i].sides == 3);
        for (const TubeNode& node : whole[i].line.nodes)
            CHECK(distance_to(tubes[i].line, node.position) < 0.6 * node.radius);
    }
}
