// Nine conifers under an overcast sky (Mech & Prusinkiewicz 1996, section 6): the surrounded one is bare below.
#include "espalier/simulation/world.h"

#include "catch.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

using namespace espalier;

namespace {

constexpr int eleven_years = 100;
constexpr std::size_t centre = 4;
constexpr std::array<std::size_t, 4> edges{1, 3, 5, 7}, corners{0, 2, 6, 8};

/// The living needle clusters of a tree, with places relative to its foot.
struct Crown {
    std::size_t clusters = 0;
    double lowest = INFINITY;
    glm::dvec2 middle{0};  ///< middle of all clusters, seen from above
};

Crown crown_of(const World& world, std::size_t tree) {
    const PlantGeometry& geometry = world.interpretation(tree).geometry;
    const glm::dvec3 foot(geometry.internodes.front().base);
    Crown crown;
    std::set<std::uint32_t> seen;  // a cluster is drawn as several needles
    for (const Polygon& needle : geometry.polygons) {
        if (!seen.insert(needle.module).second) continue;
        const glm::dvec3 place = glm::dvec3(geometry.vertices[needle.first]) - foot;
        crown.lowest = std::min(crown.lowest, place.y);
        crown.middle += glm::dvec2(place.x, place.z);
    }
    crown.clusters = seen.size();
    crown.middle /= static_cast<double>(crown.clusters);
    return crown;
}

std::vector<Crown> patch(double spacing) {
    SceneOptions options;
    options.overrides.emplace_back("plant.0.grid.spacing", std::to_string(spacing));
    World world(read_scene(source_path("environments/forest-patch.toml"), options));
    world.start();
    while (world.steps_done() < eleven_years) world.step();
    std::vector<Crown> crowns;
    for (std::size_t tree = 0; tree < world.size(); ++tree) crowns.push_back(crown_of(world, tree));
    return crowns;
}

const std::vector<Crown>& dense() {
    static const std::vector<Crown> crowns = patch(4);
    return crowns;
}
const std::vector<Crown>& far_apart() {
    static const std::vector<Crown> crowns = patch(40);
    return crowns;
}

/// How far the crown leans out of the stand, beyond what the lone tree leans by its own form.
double lean(std::size_t tree) {
    const glm::dvec2 out(static_cast<double>(tree % 3) - 1, static_cast<double>(tree / 3) - 1);
    return glm::dot(dense()[tree].middle - far_apart()[tree].middle, glm::normalize(out));
}

}  // namespace

TEST_CASE("the surrounded tree loses its lower branches, those around it do not", "[experiments][forest-patch]") {
    const Crown& lone = far_apart()[centre];
    for (const std::size_t edge : edges) {
        INFO("edge " << edge << ": " << dense()[edge].lowest << " m");
        CHECK(dense()[centre].lowest > dense()[edge].lowest + 2);
        CHECK(dense()[edge].lowest + 2 > lone.lowest);
    }
}

TEST_CASE("the more a tree is surrounded the fewer needle clusters it bears", "[experiments][forest-patch]") {
    for (const std::size_t edge : edges) {
        CHECK(dense()[centre].clusters < dense()[edge].clusters);
        for (const std::size_t corner : corners) CHECK(dense()[edge].clusters < dense()[corner].clusters);
    }
    for (const std::size_t corner : corners) CHECK(dense()[corner].clusters < far_apart()[corner].clusters);
}

TEST_CASE("the outer trees lean out by more than a metre, the inner one stands upright",
          "[experiments][forest-patch]") {
    for (const auto& group : {edges, corners}) {
        for (const std::size_t tree : group) {
            INFO("tree " << tree);
            CHECK(lean(tree) > 1);
        }
    }
    CHECK(glm::length(dense()[centre].middle - far_apart()[centre].middle) < 0.3);
}

TEST_CASE("the inner tree keeps lower branches the wider the stand", "[experiments][forest-patch]") {
    const double at_six = patch(6)[centre].lowest;
    INFO("4 m: " << dense()[centre].lowest << ", 6 m: " << at_six << ", 40 m: " << far_apart()[centre].lowest);
    CHECK(dense()[centre].lowest > at_six);
    CHECK(at_six > far_apart()[centre].lowest);
}

TEST_CASE("far apart, every tree of the stand is the lone tree", "[experiments][forest-patch]") {
    SceneOptions options;
    for (const auto* key : {"plant.0.grid.columns", "plant.0.grid.rows"}) options.overrides.emplace_back(key, "1");
    World alone(read_scene(source_path("environments/forest-patch.toml"), options));
    alone.start();
    while (alone.steps_done() < eleven_years) alone.step();
    const Crown lone = crown_of(alone, 0);
    for (const Crown& crown : far_apart()) {
        CHECK(crown.clusters == lone.clusters);
        CHECK(crown.lowest == Approx(lone.lowest).margin(1e-6));
    }
}
