#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace espalier;
using namespace espalier::environment;
using namespace espalier::test;

namespace {

const std::string plane = R"(
voxel = 0.1
domain = { lower = [0, 0, 0], upper = [1, 1, 0] }
diffusion = 0.01
begin = "steady"
)";

}  // namespace

TEST_CASE("soil between two fixed sides begins on the straight line between them", "[soil-water]") {
    Stock soil(plane + "boundaries = { bottom = { fixed = 0.4 }, top = { fixed = 0.1 } }");
    soil.stock.settle(soil.diffusion);
    for (int y = 0; y < 10; ++y) CHECK(soil.at(3, y) == Approx(0.4 - 0.3 * (y + 0.5) / 10).epsilon(1e-9));
}

// How far 50 time units of steps move a soil that begins at its steady state.
double largest_change(Stock& soil) {
    soil.stock.settle(soil.diffusion);
    const WaterBrick before = soil.stock.contents();
    soil.advance(50);
    double change = 0;
    for (std::size_t cell = 0; cell < before.size(); ++cell) {
        if (!soil.stock.faces().free(cell)) continue;
        change = std::max(change, std::abs(soil.stock.contents()[cell] - before[cell]));
    }
    return change;
}

TEST_CASE("a steady state is one that steps do not change, layers, stones and held sources included", "[soil-water]") {
    const std::string layered = plane + R"(
boundaries = { bottom = { fixed = 0.4 }, left = "open" }
layers = [{ bottom = 0.5, diffusion = 0.002 }]
obstacles = [{ shape = "sphere", center = [0.4, 0.5, 0], radius = 0.2 }]
)";
    const std::string held = R"({ shape = "sphere", center = [0.2, 0.9, 0], radius = 0.1, hold = 0.3 })";
    Stock soil(layered + "sources = [" + held + "]");
    CHECK(largest_change(soil) < 1e-9);

    // A rate is added at the beginning of a substep (here at most 0.13 time units) and has spread at its end.
    const std::string rate = R"({ shape = "sphere", center = [0.8, 0.8, 0], radius = 0.15, rate = 0.01 })";
    Stock with_rate(layered + "sources = [" + held + ", " + rate + "]");
    CHECK(largest_change(with_rate) < 0.01 * 0.13);
    with_rate.stock.measure();
    CHECK(std::abs(with_rate.stock.balance().relative_error()) < 1e-9);
}

TEST_CASE("closed soil begins at its mean and keeps its water", "[soil-water]") {
    const std::string wet_left = R"(regions = [{ shape = "box", lower = [0, 0], upper = [0.5, 1], value = 0.4 }])";
    Stock soil(plane + wet_left);
    const double before = soil.stock.balance().total;
    soil.stock.settle(soil.diffusion);
    CHECK(soil.stock.balance().total == Approx(before).epsilon(1e-12));
    CHECK(soil.stock.balance().minimum == Approx(0.2));
    CHECK(soil.stock.balance().maximum == Approx(0.2));
}

TEST_CASE("a source in closed soil never settles, and the message says what to do", "[soil-water]") {
    const std::string message = user_error([] {
        Soil soil(plane + R"(sources = [{ shape = "sphere", center = [0.5, 0.5, 0], radius = 0.2, rate = 0.1 }])");
    });
    CHECK(message.find("never settles") != std::string::npos);
    CHECK(message.find("open a side") != std::string::npos);
}

TEST_CASE("the process begins steady when its scene says so", "[soil-water]") {
    Soil soil(plane + "boundaries = { bottom = { fixed = 0.4 }, top = { fixed = 0.2 } }");
    const double total = soil.quantity("total");
    CHECK(total == Approx(100 * 0.3));
    for (int step = 0; step < 5; ++step) soil.step();
    CHECK(soil.quantity("total") == Approx(total));
}
