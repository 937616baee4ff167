// Nodes and points: the nearest node wins, whatever way it is found.
#include "environment/space/markers/colonization.h"

#include "espalier/base/random.h"
#include "espalier/base/stop.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <sstream>

using namespace espalier;
using namespace espalier::environment;

namespace {

class Cloud {
public:
    explicit Cloud(std::uint64_t seed) : samples_({seed, 0, Stream::process}, 1, 0) {}
    glm::dvec3 point(double side) {
        const double x = samples_.uniform(), y = samples_.uniform(), z = samples_.uniform();
        return side * glm::dvec3(x, y, z);
    }
    std::vector<glm::dvec3> points(std::size_t count, double side) {
        std::vector<glm::dvec3> points;
        while (points.size() < count) points.push_back(point(side));
        return points;
    }
    std::vector<ColonizingNode> nodes(std::size_t count, double side, std::uint64_t first_key) {
        std::vector<ColonizingNode> nodes;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 heading = glm::normalize(point(2) - glm::dvec3(1));
            nodes.push_back({first_key + i, point(side), heading, samples_.uniform() < 0.9});
        }
        return nodes;
    }

private:
    RandomSamples samples_;
};

bool perceives(const ColonizingNode& node, const glm::dvec3& point, const ColonizationRules& rules) {
    const glm::dvec3 towards = point - node.position;
    return rules.cosine <= -1 || glm::dot(node.heading, towards) >= rules.cosine * glm::length(towards);
}

/// Every point asks every node.
std::vector<Colonization::Won> won_by_asking_all(const Colonization& colony, const std::vector<ColonizingNode>& nodes,
                                                 const ColonizationRules& rules) {
    std::vector<Colonization::Won> won(nodes.size());
    for (std::size_t i = 0; i < colony.points().size(); ++i) {
        const glm::dvec3 point = colony.points()[i];
        std::uint32_t winner = Colonization::none;
        double least = rules.influence;
        for (std::uint32_t k = 0; colony.is_left(i) && k < nodes.size(); ++k) {
            if (!nodes[k].is_bud || (rules.perceived && !perceives(nodes[k], point, rules))) continue;
            const double distance = glm::distance(point, nodes[k].position);
            if (distance > least) continue;
            winner = k;
            least = distance;
        }
        if (winner == Colonization::none || !perceives(nodes[winner], point, rules)) continue;
        ++won[winner].count;
        won[winner].sum += glm::normalize(point - nodes[winner].position);
    }
    return won;
}

void require_same(const std::vector<Colonization::Won>& a, const std::vector<Colonization::Won>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].count == b[i].count);
        REQUIRE(glm::distance(a[i].sum, b[i].sum) < 1e-9);
    }
}

}  // namespace

TEST_CASE("the winner of a point is never missed, as nodes come, move, go and turn", "[markers]") {
    for (const ColonizationRules rules : {ColonizationRules{0.3, -1, false}, ColonizationRules{0.3, 0.5, false},
                                          ColonizationRules{0.3, 0.5, true}, ColonizationRules{INFINITY, -1, false}}) {
        Cloud cloud(7);
        Colonization colony(cloud.points(10000, 2), rules);
        std::vector<ColonizingNode> nodes = cloud.nodes(20, 2, 0);
        const auto check = [&] {
            colony.set_nodes(nodes);
            require_same(colony.won(), won_by_asking_all(colony, nodes, rules));
        };
        check();
        for (int step = 1; step < 4; ++step) {
            const auto more = cloud.nodes(30, 2, 1000U * static_cast<unsigned>(step));
            nodes.insert(nodes.begin() + step, more.begin(), more.end());
            check();
        }
        nodes[5].position += glm::dvec3(0.1);
        check();
        nodes.erase(nodes.begin() + 3);
        check();
        nodes[8].is_bud = !nodes[8].is_bud;
        check();
    }
}

TEST_CASE("points within the kill distance of any node are removed, and no others", "[markers]") {
    Cloud cloud(3);
    Colonization colony(cloud.points(5000, 1), {0.5, -1, false});
    const std::vector<ColonizingNode> nodes = cloud.nodes(12, 1, 0);
    colony.set_nodes(nodes);
    const std::size_t removed = colony.remove_within(0.15);
    CHECK(removed > 0);
    CHECK(colony.left() == 5000 - removed);
    for (std::size_t i = 0; i < 5000; ++i) {
        double least = INFINITY;
        for (const auto& node : nodes) least = std::min(least, glm::distance(node.position, colony.points()[i]));
        REQUIRE(colony.is_left(i) == (least > 0.15));
    }
    CHECK(colony.remove_within(0.15) == 0);
}

TEST_CASE("of two nodes equally near the one with the smaller key wins, in any order", "[markers]") {
    const ColonizingNode a{4, {-1, 0, 0}}, b{9, {1, 0, 0}};
    for (const auto& nodes : {std::vector{a, b}, std::vector{b, a}}) {
        Colonization colony({{0, 1, 0}}, {5, -1, false});
        colony.set_nodes(nodes);
        for (std::size_t i = 0; i < 2; ++i) CHECK(colony.won()[i].count == (nodes[i].key == 4 ? 1U : 0U));
    }
}

TEST_CASE("what was removed stays removed after a restart", "[markers]") {
    Cloud cloud(5);
    const auto points = cloud.points(3000, 1);
    const auto nodes = cloud.nodes(10, 1, 0);
    Colonization colony(points, {0.4, -1, false}), other(points, {0.4, -1, false});
    colony.set_nodes(nodes);
    colony.remove_within(0.2);
    std::stringstream bytes;
    colony.save(bytes);
    other.restore(bytes);
    CHECK(other.left() == colony.left());
    other.set_nodes(nodes);
    require_same(other.won(), colony.won());
    Colonization smaller({{0, 0, 0}}, {1, -1, false});
    bytes.seekg(0);
    CHECK_THROWS(smaller.restore(bytes));
}

TEST_CASE("the sorting of many points ends when it is asked to", "[markers]") {
    StopRequest request;
    const StopRequest::Scope scope(&request);
    const auto points = Cloud(6).points(20000, 1);
    CHECK_NOTHROW(Colonization(points, {0.4, -1, false}));
    request.ask();
    CHECK_THROWS_AS(Colonization(points, {0.4, -1, false}), Stopped);
}
