// Hedges clipped to shapes: the dinosaur of four plants, the same plants without a shape, a hedge clipped lower later.
#include "espalier/environment/shape.h"

#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

using namespace espalier;

namespace {

constexpr double kSegment = 0.2, kStub = 0.02;

std::shared_ptr<const Shape> shape_of(const std::string& file) {
    const Scene scene = read_scene(source_path(file));
    Settings table = scene.environment.processes.front().second;
    return read_shape(table);
}

/// Points of the shape's surface, one for each point of a cubic grid that is near it.
std::vector<glm::dvec3> surface_points(const Shape& shape, double spacing) {
    std::vector<glm::dvec3> points;
    const Box box = *shape.bounds();
    for (double x = box.lower.x - spacing; x < box.upper.x + spacing; x += spacing) {
        for (double y = box.lower.y - spacing; y < box.upper.y + spacing; y += spacing) {
            for (double z = box.lower.z - spacing; z < box.upper.z + spacing; z += spacing) {
                const auto sample = shape.sample({x, y, z});
                if (std::abs(sample.distance) < spacing / 2 && sample.nearest.y > 0) points.push_back(sample.nearest);
            }
        }
    }
    return points;
}

/// Fraction of `points` within `reach` of a vertex of a leaf.
double covered(const std::vector<glm::dvec3>& points, const World& world, double reach) {
    const auto near = [&](const glm::dvec3& point) {
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            const auto& vertices = world.interpretation(plant).geometry.vertices;
            if (std::any_of(vertices.begin(), vertices.end(), [&](const glm::dvec3& vertex) {
                    const glm::dvec3 d = vertex - point;
                    return glm::dot(d, d) <= reach * reach;
                })) {
                return true;
            }
        }
        return false;
    };
    return static_cast<double>(std::count_if(points.begin(), points.end(), near)) / static_cast<double>(points.size());
}

std::string symbol(const World& world, std::size_t plant, std::size_t module) {
    return world.model(plant).alphabet.name(world.string(plant).letters[module]);
}

std::map<std::string, int> letter_counts(const World& world, std::size_t plant) {
    std::map<std::string, int> letter_counts;
    for (LetterId letter : world.string(plant).letters) ++letter_counts[world.model(plant).alphabet.name(letter)];
    return letter_counts;
}

/// Buds with a signal right behind them.
int buds_met(const World& world, std::size_t plant) {
    int met = 0;
    for (std::size_t i = 1; i < world.string(plant).size(); ++i) {
        met += symbol(world, plant, i - 1) == "K" && symbol(world, plant, i) == "S" ? 1 : 0;
    }
    return met;
}

std::set<Identity> identities(const World& world, std::size_t plant, const std::string& of) {
    std::set<Identity> found;
    const ModuleString& string = world.string(plant);
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (symbol(world, plant, i) == of) found.insert(string.identity(i));
    }
    return found;
}

int missing(const std::set<Identity>& before, const std::set<Identity>& now) {
    return static_cast<int>(
        std::count_if(before.begin(), before.end(), [&](Identity bud) { return !now.contains(bud); }));
}

/// The dinosaur grown once, and what the tests ask of it.
struct Dinosaur {
    std::map<int, double> coverage;  ///< by step
    double coverage_closer = 0;      ///< in the end, within half the reach
    int outside = 0, stayed = 0;     ///< internodes seen outside; of these, those seen in the following step too
    double worst_stub = 0;           ///< how far a stub ends outside
    int met = 0, awake = 0;
    std::vector<double> lengths;  ///< lengths of wood, by plant
    Box bounds;

    Dinosaur() {
        const std::string file = "environments/topiary-3d.toml";
        const auto shape = shape_of(file);
        const auto surface = surface_points(*shape, 0.2);
        const Scene scene = read_scene(source_path(file));
        World world(scene);
        world.start();
        for (int step = 1; step <= world.last_step(); ++step) {
            std::vector<std::set<Identity>> buds;
            for (std::size_t plant = 0; plant < world.size(); ++plant) {
                met += buds_met(world, plant);
                buds.push_back(identities(world, plant, "K"));
            }
            world.step();
            for (std::size_t plant = 0; plant < world.size(); ++plant) {
                awake += missing(buds[plant], identities(world, plant, "K"));
                measure(world, plant, *shape);
            }
            if (step % 40 == 0) coverage[step] = covered(surface, world, kSegment);
        }
        coverage_closer = covered(surface, world, kSegment / 2);
        for (std::size_t plant = 0; plant < world.size(); ++plant) {
            lengths.push_back(total_length(world.interpretation(plant).geometry));
            bounds.add(world.interpretation(plant).geometry.bounds);
        }
    }

    void measure(const World& world, std::size_t plant, const Shape& shape) {
        std::set<Identity> outside_now;
        for (const Internode& internode : world.interpretation(plant).geometry.internodes) {
            const Identity identity = world.string(plant).identity(internode.module);
            const auto [known, is_new] = excess_.try_emplace(identity, 0);
            if (is_new) known->second = shape.distance(internode.tip);
            if (known->second <= 0) continue;
            if (symbol(world, plant, internode.module) == "F") {
                worst_stub = std::max(worst_stub, known->second);
                continue;
            }
            outside_now.insert(identity);
            ++outside;
            stayed += outside_[plant].contains(identity) ? 1 : 0;
        }
        outside_[plant] = outside_now;
    }

private:
    std::map<Identity, double> excess_;
    std::map<std::size_t, std::set<Identity>> outside_;
};

const Dinosaur& dinosaur() {
    static const Dinosaur grown_once;
    return grown_once;
}

}  // namespace

TEST_CASE("dinosaur: an apex outside is cut in the following step, and no segment stays outside beyond its stub",
          "[topiary]") {
    CHECK(dinosaur().outside > 1000);
    CHECK(dinosaur().stayed == 0);
    CHECK(dinosaur().worst_stub <= kStub);
}

TEST_CASE("dinosaur: buds wake as often as a signal meets one", "[topiary]") {
    CHECK(dinosaur().awake > 1000);
    CHECK(dinosaur().awake == dinosaur().met);
}

TEST_CASE("dinosaur: leaves come within 0.2 m of more and more of the surface, in the end of more than 0.8 of it",
          "[topiary]") {
    double before = 0;
    for (const auto& [step, coverage] : dinosaur().coverage) {
        CHECK(coverage > before);
        before = coverage;
    }
    CHECK(before > 0.8);
    CHECK(dinosaur().coverage_closer > 0.8);
}

TEST_CASE("dinosaur: all four plants have a share in it, from nose to tail", "[topiary]") {
    const double all = dinosaur().lengths[0] + dinosaur().lengths[1] + dinosaur().lengths[2] + dinosaur().lengths[3];
    for (double length : dinosaur().lengths) CHECK(length > 0.05 * all);
    CHECK(dinosaur().bounds.lower.x < -4.5);
    CHECK(dinosaur().bounds.upper.x > 4.1);
    CHECK(dinosaur().bounds.upper.y > 5.8);
}

TEST_CASE("without its shape a hedge grows out and nothing is ever cut", "[topiary]") {
    const auto world = grown("environments/topiary-free.toml");
    Box bounds;
    for (std::size_t plant = 0; plant < world->size(); ++plant) {
        auto symbols = letter_counts(*world, plant);
        CHECK(symbols["S"] + symbols["F"] + symbols["%"] == 0);
        bounds.add(world->interpretation(plant).geometry.bounds);
    }
    CHECK(bounds.upper.y > 7.5);
    CHECK(bounds.lower.x < -6);
    CHECK(bounds.upper.x > 6);
}

TEST_CASE("a hedge clipped closer grows anew near the cut, not in its core", "[topiary]") {
    const std::string file = "environments/topiary-shrinking.toml";
    World clipped(read_scene(source_path(file)));
    World left_alone(read_scene(source_path(file), {{{"environment.hedge.motion.growth", "[0, 0]"}}, {}, {}}));
    const auto grow_both = [&](int steps) {
        for (int step = 0; step < steps; ++step) {
            clipped.step();
            left_alone.step();
        }
    };
    clipped.start();
    left_alone.start();
    grow_both(100);
    const auto modules = letter_counts(clipped, 0);
    REQUIRE(modules == letter_counts(left_alone, 0));
    const std::set<Identity> before = identities(clipped, 0, "I");
    grow_both(6);

    // Per old node that was left: shoots that the clipping called forth, near the new surface and in the core.
    const auto closer = grown_and_moved(shape_of(file), -0.3, {0, 0, 0});
    const auto near_cut = [&](const glm::dvec3& point) { return closer->distance(point) > -3 * kSegment; };
    const std::set<Identity> without_cut = identities(left_alone, 0, "I");
    int nodes_near = 0, nodes_in_core = 0, shoots_near = 0, shoots_in_core = 0;
    std::vector<glm::dvec3> old_nodes;
    for (const Internode& internode : clipped.interpretation(0).geometry.internodes) {
        if (symbol(clipped, 0, internode.module) != "I") continue;
        CHECK(closer->distance(internode.base) <= 1e-9);
        const Identity identity = clipped.string(0).identity(internode.module);
        if (before.contains(identity)) {
            ++(near_cut(internode.tip) ? nodes_near : nodes_in_core);
            old_nodes.push_back(internode.tip);
        } else if (!without_cut.contains(identity)) {
            const bool on_old_wood = std::any_of(old_nodes.begin(), old_nodes.end(), [&](const glm::dvec3& node) {
                return glm::distance(node, internode.base) < 1e-9;
            });
            if (on_old_wood) ++(near_cut(internode.base) ? shoots_near : shoots_in_core);
        }
    }
    CHECK(shoots_near > 50);
    CHECK(nodes_in_core > 100);
    CHECK(shoots_near * nodes_in_core > 10 * shoots_in_core * nodes_near);
}
