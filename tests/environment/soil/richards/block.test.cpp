// Soils of two and three dimensions.
#include "catch.h"
#include "environment/soil/richards/column.h"

#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <sstream>

namespace espalier::test {
namespace {

const std::string drip_on_loam = R"(
domain = { lower = [-0.2, -0.4, -0.2], upper = [0.2, 0, 0.2] }
voxel = 0.02
soil = "loam"
initial = { head = -300 }
layers = [{ top = -0.25, soil = "sand", slope = 5 }]
sources = [{ shape = "sphere", center = [0.05, -0.1, 0], radius = 0.03, rate = 5 }]
boundaries = { top = { rain = 20, evaporation = 3 }, bottom = "free-drainage" }
)";

std::vector<double> heads_after(const std::string& text, double days, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    SoilBlock block(text);
    block.advance(days);
    return {block.soil.heads().begin(), block.soil.heads().end()};
}

}  // namespace

TEST_CASE("soil that is the same across is a column", "[environment][soil]") {
    const std::string rest =
        "soil = \"sandy loam\"\ninitial = { head = -200 }\n"
        "boundaries = { top = { rain = 60 }, bottom = \"free-drainage\" }";
    SoilBlock column(column_of(0.4, 0.02, rest));
    SoilBlock block("domain = { lower = [0, -0.4, 0], upper = [0.1, 0, 0.12] }\nvoxel = 0.02\n" + rest);
    column.advance(0.5);
    block.advance(0.5);
    for (int y = 0; y < column.height(); ++y) {
        CHECK(block.head(y, 0, 0) == Approx(column.head(y)).epsilon(1e-6));
        CHECK(block.head(y, 3, 4) == Approx(block.head(y, 0, 0)).epsilon(1e-6));
    }
}

TEST_CASE("any number of threads gives the same bytes", "[environment][soil]") {
    const std::vector<double> one = heads_after(drip_on_loam, 0.05, 1), two = heads_after(drip_on_loam, 0.05, 2);
    CHECK(std::memcmp(one.data(), two.data(), one.size() * sizeof(double)) == 0);
}

TEST_CASE("a drip line wets a bulb, and every drop is accounted for", "[environment][soil]") {
    SoilBlock block(drip_on_loam);
    block.advance(0.2);
    CHECK(block.flown().added > 0);
    CHECK(std::abs(block.soil.balance().relative_error()) < 1e-10);
    const glm::ivec3 drip(12, 14, 10);  // at (0.05, -0.11, 0.01)
    CHECK(block.content(drip.y, drip.x, drip.z) > 0.3);
    CHECK(block.content(drip.y, 1, drip.z) < block.content(drip.y, drip.x, drip.z) - 0.03);
}

TEST_CASE("with periodic sides it does not matter where the domain begins", "[environment][soil]") {
    const auto lens = [](double shift) {
        return fmt::format(
            "domain = {{ lower = [0, -0.2, 0], upper = [0.2, 0, 0.2] }}\nvoxel = 0.02\nsoil = \"loam\"\ninitial = {{ "
            "head = "
            "-200 }}\nregions = [{{ shape = \"box\", lower = [{0}, -0.12, {0}], upper = [{1}, -0.06, {1}], soil = "
            "\"sand\", "
            "initial = {{ head = -20 }} }}]\nboundaries = {{ sides = \"periodic\", top = {{ rain = 30 }}, bottom = "
            "\"free-drainage\" }}",
            shift, shift + 0.06);
    };
    SoilBlock here(lens(0)), there(lens(0.08));
    here.advance(0.2);
    there.advance(0.2);
    for (int y = 0; y < here.height(); ++y) {
        for (int x = 0; x < 10; ++x) {
            CHECK(there.head(y, (x + 4) % 10, (3 + 4) % 10) == Approx(here.head(y, x, 3)).epsilon(1e-4));
        }
    }
}

TEST_CASE("a wet lens in a plane spreads to both sides alike, and further down than up", "[environment][soil]") {
    SoilBlock plane(R"(
domain = { lower = [-0.2, -0.4, 0], upper = [0.2, 0, 0] }
voxel = 0.01
soil = "loam"
initial = { head = -500 }
regions = [{ shape = "sphere", center = [0, -0.2, 0], radius = 0.05, initial = { head = -10 } }])");
    plane.advance(0.5);
    const double outside = plane.parameters.kinds[0].at(-500).content;
    double up = 0, down = 0;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 20; ++x) CHECK(plane.head(y, x) == Approx(plane.head(y, 39 - x)).epsilon(1e-6));
        (y < 20 ? down : up) += plane.content(y, 20) - outside;
    }
    CHECK(down > 1.05 * up);
    CHECK(std::abs(plane.soil.balance().relative_error()) < 1e-12);
}

TEST_CASE("a soil saved and restored goes on with the same bytes", "[environment][soil]") {
    SoilBlock straight(drip_on_loam), before(drip_on_loam), after(drip_on_loam);
    straight.advance(0.03);
    straight.advance(0.02);
    before.advance(0.03);
    std::stringstream bytes;
    before.soil.save(bytes);
    after.soil.restore(bytes);
    after.advance(0.02);
    CHECK(std::memcmp(after.soil.heads().data(), straight.soil.heads().data(),
                      straight.soil.heads().size() * sizeof(double)) == 0);
    CHECK(after.flown().evaporation == straight.flown().evaporation);
}

}  // namespace espalier::test
