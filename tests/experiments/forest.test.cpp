// A stand of trees that compete for light: who stands at the edge keeps what those inside must shed.
#include "espalier/simulation/world.h"

#include "catch.h"
#include "experiments/growth.h"

using namespace espalier;

namespace {

constexpr int side_of_stand = 8;

/// Sums over the trees at the edge of the stand, and over those with two trees between them and the open.
template <class Quantity>
double edge_over_inside(const World& world, const Quantity& quantity) {
    double edge = 0, inside = 0;
    int at_edge = 0, within = 0;
    for (std::size_t tree = 0; tree < world.size(); ++tree) {
        const int column = static_cast<int>(tree) % side_of_stand, row = static_cast<int>(tree) / side_of_stand;
        const int depth = std::min({column, row, side_of_stand - 1 - column, side_of_stand - 1 - row});
        if (depth == 0) edge += quantity(tree), ++at_edge;
        if (depth >= 2) inside += quantity(tree), ++within;
    }
    return (edge / at_edge) / (inside / within);
}

}  // namespace

TEST_CASE("trees at the edge of a stand outgrow those inside, once the crowns have met", "[experiments][forest]") {
    SceneOptions options;
    for (const char* count : {"plant.0.grid.columns", "plant.0.grid.rows"}) {
        options.overrides.emplace_back(count, std::to_string(side_of_stand));
    }
    options.steps = 94;
    World world(read_scene(source_path("environments/forest.toml"), options));
    REQUIRE(world.size() == side_of_stand * side_of_stand);
    const auto modules = [&](std::size_t tree) { return static_cast<double>(world.string(tree).size()); };
    const auto wood = [&](std::size_t tree) { return total_length(world.interpretation(tree).geometry); };
    world.start();
    while (world.steps_done() < 49) world.step();
    const double young = edge_over_inside(world, modules);
    while (world.steps_done() < 94) world.step();
    const double old = edge_over_inside(world, wood);
    INFO("modules at step 49: " << young << ", wood at step 94: " << old);
    CHECK(young == Approx(1).margin(0.02));
    CHECK(old > 1.3);
    CHECK(old < 2.5);
}
