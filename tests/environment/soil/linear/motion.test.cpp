// Diffusion and relaxation: what published solutions and conservation say.
#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <fmt/format.h>
#include <glm/vector_relational.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace espalier::test {
namespace {

/// Variance of the content along each axis, and its sum.
struct Spread {
    glm::dvec3 variance{0};
    double sum = 0;
};

Spread spread(const Stock& soil) {
    Spread spread;
    glm::dvec3 mean{0};
    const glm::ivec3 size = soil.grid.size();
    const auto each = [&](auto visit) {
        for (int z = 0; z < size.z; ++z) {
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) visit(soil.grid.centre({x, y, z}), soil.at(x, y, z));
            }
        }
    };
    each([&](const glm::dvec3& p, double c) {
        spread.sum += c;
        mean += c * p;
    });
    mean /= spread.sum;
    each([&](const glm::dvec3& p, double c) { spread.variance += c * (p - mean) * (p - mean) / spread.sum; });
    return spread;
}

std::string point_source(const std::string& domain) {
    return domain + R"(
diffusion = 2e-4
regions = [{ shape = "sphere", center = [0, 0, 0], radius = 0.004, value = 1 }]
)";
}

/// Obstacles, layers, a source and an open side at once; irregular contents.
const char* const busy_soil = R"(
domain = { lower = [-1, -1, -1], upper = [1, 1, 1] }
voxel = 0.1
initial = 0.3
diffusion = 0.004
anisotropy = [1, 0.5, 2]
layers = [{ bottom = -1, top = 0.05, diffusion = 0.02, initial = 0.1 }]
regions = [{ shape = "sphere", center = [0.3, 0.2, 0.1], radius = 0.5, value = 0.45, edge = 0.2 }]
obstacles = [{ shape = "sphere", center = [-0.3, 0, 0], radius = 0.35 },
             { shape = "box", lower = [0.2, -0.5, -1], upper = [0.4, -0.3, 1] }]
sources = [{ shape = "sphere", center = [0.7, 0.7, 0.7], radius = 0.15, rate = 0.01 },
           { shape = "sphere", center = [-0.7, 0.7, 0.7], radius = 0.15, hold = 0.5 }]
boundaries = { bottom = "open", top = { fixed = 0.4 }, left = { fixed = 0.2 }, front = "open" }
)";

}  // namespace

TEST_CASE("the variance of a point source grows by 2 D t along every axis", "[environment][water]") {
    const int dimensions = GENERATE(1, 2, 3);
    const std::string lower[] = {"[-1.005, -0.005, 0]", "[-0.505, -0.505, 0]", "[-0.255, -0.255, -0.255]"};
    const std::string upper[] = {"[1.005, 0.005, 0]", "[0.505, 0.505, 0]", "[0.255, 0.255, 0.255]"};
    Stock soil(point_source(fmt::format("domain = {{ lower = {}, upper = {} }}\nvoxel = 0.01", lower[dimensions - 1],
                                        upper[dimensions - 1])));
    const double t = 5;
    for (int step = 0; step < 5; ++step) soil.advance(t / 5);
    const Spread result = spread(soil);
    CHECK(result.sum == Approx(1).epsilon(1e-12));
    for (int axis = 0; axis < dimensions; ++axis) {
        CHECK(result.variance[axis] == Approx(2 * 2e-4 * t).epsilon(0.02));
    }
}

TEST_CASE("anisotropy scales the spread of each axis by its own factor", "[environment][water]") {
    Stock soil(
        point_source("domain = { lower = [-0.605, -0.605, 0], upper = [0.605, 0.605, 0] }\nvoxel = 0.01\n"
                     "anisotropy = [4, 0.25, 1]"));
    soil.advance(5);
    const Spread result = spread(soil);
    CHECK(result.variance.x == Approx(2 * 8e-4 * 5).epsilon(0.02));
    CHECK(result.variance.y == Approx(2 * 0.5e-4 * 5).epsilon(0.02));
}

TEST_CASE("a wet voxel spreads to the Gaussian of the heat equation", "[environment][water]") {
    Stock soil(point_source("domain = { lower = [-0.505, -0.505, 0], upper = [0.505, 0.505, 0] }\nvoxel = 0.01"));
    soil.advance(5);
    const double variance = 2 * 2e-4 * 5;
    for (const int x : {50, 53, 56}) {
        const glm::dvec3 p = soil.grid.centre({x, 50, 0});
        const double gauss = 1e-4 / (2 * M_PI * variance) * std::exp(-p.x * p.x / (2 * variance));
        CHECK(soil.at(x, 50) == Approx(gauss).epsilon(0.02));
    }
}

TEST_CASE("substeps keep D dt / h^2 within 1 / (2 dimensions)", "[environment][water]") {
    const auto substeps = [](const std::string& domain, double dt) {
        Stock soil("voxel = 0.1\ndiffusion = 0.01\n" + domain);
        return soil.diffusion.substeps(dt);
    };
    const std::string line = "domain = { lower = [0, 0, 0], upper = [1, 0.1, 0] }";
    const std::string plane = "domain = { lower = [0, 0, 0], upper = [1, 1, 0] }";
    const std::string space = "domain = { lower = [0, 0, 0], upper = [1, 1, 1] }";
    for (const double dt : {0.1, 1.0, 7.0}) {
        CHECK(dt / substeps(line, dt) <= 0.5 + 1e-9);
        CHECK(dt / substeps(plane, dt) <= 0.25 + 1e-9);
        CHECK(dt / substeps(space, dt) <= 1.0 / 6 + 1e-9);
    }
    CHECK(substeps(space, 7) == 84);
}

TEST_CASE("a step that needs too many substeps is an error that says so", "[environment][water]") {
    Stock soil("voxel = 0.01\ndiffusion = 1\nmax_substeps = 1000\ndomain = { lower = [0, 0, 0], upper = [1, 1, 0] }");
    const std::string message = user_error([&] { soil.advance(1); });
    CHECK(message.find("80000 substeps") != std::string::npos);
    CHECK(message.find("max_substeps is 1000") != std::string::npos);
    CHECK(soil.stock.balance().added == 0);
}

TEST_CASE("water lost and gained is accounted for to 1e-9 among obstacles, sources and open sides",
          "[environment][water]") {
    Stock soil(busy_soil);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.95, 0.95), wish(0, 0.4);
    for (int step = 0; step < 50; ++step) {
        soil.advance(1);
        std::vector<WaterWish> wishes;
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 p{place(random), place(random), place(random)};
            wishes.push_back(
                {sample_water(soil.grid, soil.stock.faces(), soil.stock.contents(), p).stencil, wish(random)});
        }
        soil.stock.drink([&](WaterBrick& stock) { return share_water(soil.grid, wishes, stock).taken; });
        soil.stock.measure();
        REQUIRE(std::abs(soil.stock.balance().relative_error()) < 1e-12);
        REQUIRE(soil.stock.balance().minimum >= 0);
    }
    CHECK(soil.stock.balance().drunk > 10);
    CHECK(soil.stock.balance().added > 1);
    CHECK(std::abs(soil.stock.balance().boundary) > 1);
}

TEST_CASE("fixed sides reach the straight line between them", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [0, 0, 0], upper = [1, 0.2, 0] }
voxel = 0.05
diffusion = 0.02
boundaries = { left = { fixed = 0.4 }, right = { fixed = 0.1 } }
)");
    soil.advance(400);
    for (int x = 0; x < 20; ++x) {
        CHECK(soil.at(x, 1) == Approx(0.4 - 0.3 * soil.grid.centre({x, 0, 0}).x).epsilon(1e-6));
    }
}

TEST_CASE("an open side drains the soil at the rate of the first Fourier mode", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [0, 0, 0], upper = [0.05, 1, 0] }
voxel = 0.02
initial = 0.3
diffusion = 0.01
boundaries = { bottom = "open" }
)");
    soil.advance(40);
    soil.stock.measure();
    const double early = soil.stock.balance().total;
    soil.advance(40);
    soil.stock.measure();
    // Zero at the bottom, no flux at the top: exp(-D (pi / 2 H)^2 t).
    CHECK(soil.stock.balance().total / early == Approx(std::exp(-0.01 * M_PI * M_PI / 4 * 40)).epsilon(1e-3));
}

TEST_CASE("between layers the flux is that of conductances in series", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [0, -1, 0], upper = [0.1, 1, 0] }
voxel = 0.1
diffusion = 0.01
layers = [{ bottom = -1, top = 0, diffusion = 0.04 }]
boundaries = { top = { fixed = 1 }, bottom = "open" }
)");
    soil.advance(2000);
    // Steady: 1 / (1 / 0.01 + 1 / 0.04) = 0.008 through both layers.
    for (int y = 1; y < 20; ++y) {
        if (y == 10) continue;
        const double flux = (y < 10 ? 0.04 : 0.01) * (soil.at(0, y) - soil.at(0, y - 1)) / 0.1;
        CHECK(flux == Approx(0.008).epsilon(1e-6));
    }
    const double across = 2 * 0.04 * 0.01 / 0.05 * (soil.at(0, 10) - soil.at(0, 9)) / 0.1;
    CHECK(across == Approx(0.008).epsilon(1e-6));
}

TEST_CASE("no water passes an obstacle and none is in it", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [-1, -1, 0], upper = [1, 1, 0] }
voxel = 0.1
diffusion = 0.05
regions = [{ shape = "box", lower = [-1, -1, -1], upper = [-0.2, 1, 1], value = 0.5 }]
obstacles = [{ shape = "box", lower = [-0.2, -1, -1], upper = [0.2, 1, 1] }]
)");
    soil.advance(200);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            const double c = soil.at(x, y);
            if (x < 8) CHECK(c == Approx(0.5).epsilon(1e-12));
            if (x >= 8) CHECK(c == 0);
            CHECK(soil.free(x, y) == (x < 8 || x >= 12));
        }
    }
}

TEST_CASE("a mirrored soil stays mirrored to the last bit", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [-1, -1, -1], upper = [1, 1, 1] }
voxel = 0.13
diffusion = 0.01
initial = 0.2
regions = [{ shape = "sphere", center = [0, 0.3, 0], radius = 0.5, value = 0.45, edge = 0.3 }]
obstacles = [{ shape = "sphere", center = [0.5, 0, 0], radius = 0.3 },
             { shape = "sphere", center = [-0.5, 0, 0], radius = 0.3 }]
boundaries = { left = "open", right = "open", top = { fixed = 0.3 } }
)");
    for (int step = 0; step < 10; ++step) soil.advance(1);
    const glm::ivec3 size = soil.grid.size();
    bool same = true;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                same = same && soil.at(x, y, z) == soil.at(size.x - 1 - x, y, z);
                same = same && soil.at(x, y, z) == soil.at(x, y, size.z - 1 - z);
            }
        }
    }
    CHECK(same);
    CHECK(soil.at(0, 8, 8) != soil.at(4, 8, 8));
}

TEST_CASE("the same bytes come from one thread and from two", "[environment][water]") {
    const auto contents = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::string text = busy_soil;
        text.replace(text.find("voxel = 0.1"), 11, "voxel = 0.05");
        Soil soil(text);
        for (int step = 0; step < 3; ++step) {
            std::vector<Tip> tips;
            for (int i = 0; i < 500; ++i) tips.push_back({{0.9 * std::sin(i), 0.9 * std::cos(i * i), 0.3}, {0.1}});
            soil.step(tips);
        }
        return soil.saved();
    };
    CHECK(contents(1) == contents(2));
}

TEST_CASE("relaxation is the mean of the free neighbours, weighted with the old content", "[environment][water]") {
    // 3 x 2 voxels, the one at (2, 1) an obstacle:   0  8  #
    //                                                1  4  2
    Stock soil(R"(
domain = { lower = [0, 0, 0], upper = [3, 2, 0] }
voxel = 1
mode = "relaxation"
relaxation = 0.25
regions = [{ shape = "sphere", center = [0.5, 0.5, 0], radius = 0.1, value = 1 },
           { shape = "sphere", center = [1.5, 0.5, 0], radius = 0.1, value = 4 },
           { shape = "sphere", center = [2.5, 0.5, 0], radius = 0.1, value = 2 },
           { shape = "sphere", center = [1.5, 1.5, 0], radius = 0.1, value = 8 }]
obstacles = [{ shape = "sphere", center = [2.5, 1.5, 0], radius = 0.4 }]
)");
    soil.stock.relax(1);
    CHECK(soil.at(0, 0) == Approx(0.75 * 1 + 0.25 * (4 + 0) / 2));
    CHECK(soil.at(1, 0) == Approx(0.75 * 4 + 0.25 * (1 + 2 + 8) / 3));
    CHECK(soil.at(2, 0) == Approx(0.75 * 2 + 0.25 * 4));
    CHECK(soil.at(0, 1) == Approx(0.75 * 0 + 0.25 * (1 + 8) / 2));
    CHECK(soil.at(1, 1) == Approx(0.75 * 8 + 0.25 * (0 + 4) / 2));
    CHECK(soil.at(2, 1) == 0);
    soil.stock.measure();
    const double now = 0.75 * 15 + 0.25 * (2 + 11.0 / 3 + 4 + 4.5 + 2);
    CHECK(soil.stock.balance().relative_error() == Approx((15 - now) / now));
}

TEST_CASE("relaxation stops at its tolerance and holds its sources", "[environment][water]") {
    const auto relaxed = [](const std::string& limits) {
        Stock soil(R"(
domain = { lower = [0, 0, 0], upper = [4, 1, 0] }
voxel = 1
mode = "relaxation"
sources = [{ shape = "sphere", center = [0.5, 0.5, 0], radius = 0.1, hold = 1 }]
)" + limits);
        soil.stock.relax(1);
        return std::pair(soil.at(0), soil.at(3));
    };
    CHECK(relaxed("sweeps = 3") == std::pair(1.0, 0.03125));
    CHECK(relaxed("sweeps = 1000").second == Approx(1).epsilon(1e-6));
    const double early = relaxed("sweeps = 1000\ntolerance = 0.01").second;
    CHECK(early > 0.5);
    CHECK(early < 0.99);
}

/// A plain grid after the rule of cpfg's program `soil`: voxels of any contents, stones, and one that is held.
struct PlainSoil {
    static constexpr int nx = 6, ny = 5, nz = 4;
    static constexpr glm::ivec3 held{0, 2, 1};
    std::vector<double> contents;
    std::vector<bool> stone;

    explicit PlainSoil(unsigned seed) {
        std::mt19937 chance(seed);
        for (int i = 0; i < nx * ny * nz; ++i) {
            contents.push_back(double(chance() % 1000) / 1000);
            stone.push_back(chance() % 7 == 0);
        }
        stone[index(held)] = false;
        contents[index(held)] = 1;
    }

    static std::size_t index(const glm::ivec3& v) { return std::size_t(v.x + nx * (v.y + ny * v.z)); }

    std::string toml() const {
        std::string regions, stones;
        for (int z = 0; z < nz; ++z) {
            for (int y = 0; y < ny; ++y) {
                for (int x = 0; x < nx; ++x) {
                    const std::size_t i = index({x, y, z});
                    const std::string ball = fmt::format("{{ shape = 'sphere', center = [{}, {}, {}], radius = 0.1",
                                                         x + 0.5, y + 0.5, z + 0.5);
                    if (stone[i]) stones += ball + " }, ";
                    if (!stone[i]) regions += ball + fmt::format(", value = {} }}, ", contents[i]);
                }
            }
        }
        return fmt::format(
            "domain = {{ lower = [0, 0, 0], upper = [{}, {}, {}] }}\nvoxel = 1\nregions = [{}]\n"
            "obstacles = [{}]\nmode = 'relaxation'\nsources = [{{ shape = 'sphere', center = [{}, {}, "
            "{}], radius = 0.1, hold = 1 }}]\n",
            nx, ny, nz, regions, stones, held.x + 0.5, held.y + 0.5, held.z + 0.5);
    }

    /// One sweep; returns the largest change.
    double sweep(double weight) {
        const std::vector<double> old = contents;
        double largest = 0;
        for (int i = 0; i < nx * ny * nz; ++i) {
            const glm::ivec3 v(i % nx, i / nx % ny, i / (nx * ny));
            double sum = 0;
            int free = 0;
            for (const glm::ivec3& side : {glm::ivec3(1, 0, 0), glm::ivec3(0, 1, 0), glm::ivec3(0, 0, 1)}) {
                for (const glm::ivec3& other : {v + side, v - side}) {
                    const bool within = glm::all(glm::greaterThanEqual(other, glm::ivec3(0))) &&
                                        glm::all(glm::lessThan(other, glm::ivec3(nx, ny, nz)));
                    if (!within || stone[index(other)]) continue;
                    sum += old[index(other)];
                    ++free;
                }
            }
            if (stone[std::size_t(i)] || free == 0 || v == held) continue;
            contents[std::size_t(i)] = (1 - weight) * old[std::size_t(i)] + weight * sum / free;
            largest = std::max(largest, std::abs(contents[std::size_t(i)] - old[std::size_t(i)]));
        }
        return largest;
    }
};

TEST_CASE("relaxation has the numbers of the documented rule: any contents, stones and a source",
          "[environment][water]") {
    const unsigned seed = GENERATE(11u, 12u, 13u);
    const double weight = GENERATE(0.5, 0.37);
    PlainSoil plain(seed);
    Stock soil(plain.toml() + fmt::format("sweeps = 3\nrelaxation = {}\n", weight));
    for (int step = 0; step < 4; ++step) {
        soil.stock.relax(1);
        for (int sweep = 0; sweep < 3; ++sweep) plain.sweep(weight);
        double worst = 0;
        for (int i = 0; i < PlainSoil::nx * PlainSoil::ny * PlainSoil::nz; ++i) {
            const glm::ivec3 v(i % PlainSoil::nx, i / PlainSoil::nx % PlainSoil::ny,
                               i / (PlainSoil::nx * PlainSoil::ny));
            if (plain.stone[std::size_t(i)]) continue;
            worst = std::max(worst, std::abs(soil.at(v.x, v.y, v.z) - plain.contents[std::size_t(i)]));
        }
        INFO("seed " << seed << ", weight " << weight << ", step " << step);
        CHECK(worst < 1e-14);
    }
}

TEST_CASE("the direction of roots has the numbers of the documented rule", "[environment][water]") {
    // Weights g and h: g down + h (difference of the two neighbours) / (2 range), as cpfg's `soil` answers.
    PlainSoil plain(21);
    std::fill(plain.stone.begin(), plain.stone.end(), false);
    Soil soil(plain.toml() + "range = 0.8\ndepletion = false\n");
    const double g = 0.3, h = 0.7;
    for (const glm::ivec3& v : {glm::ivec3(2, 2, 1), glm::ivec3(4, 3, 2), glm::ivec3(1, 1, 2)}) {
        const auto answer = soil.ask({{glm::dvec3(v) + 0.5, {0.05, g, h, 0}}})[0];
        CHECK(answer[0] == Approx(std::min(0.05, plain.contents[PlainSoil::index(v)])));
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 side(0);
            side[axis] = 1;
            const double rise = plain.contents[PlainSoil::index(v + side)] - plain.contents[PlainSoil::index(v - side)];
            CHECK(answer[std::size_t(axis + 1)] == Approx(h * rise / (2 * 0.8) - (axis == 1 ? g : 0)).margin(1e-6));
        }
    }
}

TEST_CASE("sources add their rate to each of their voxels, or hold their content", "[environment][water]") {
    Stock soil(R"(
domain = { lower = [0, 0, 0], upper = [2, 2, 0] }
voxel = 0.1
initial = 0.1
diffusion = 0.001
sources = [{ shape = "box", lower = [0.4, 0.4], upper = [0.6, 0.6], rate = 0.02 },
           { shape = "box", lower = [1.4, 1.4], upper = [1.6, 1.6], hold = 0.3 }]
)");
    for (int step = 0; step < 3; ++step) soil.advance(2);
    soil.stock.measure();
    CHECK(soil.at(14, 14) == 0.3);
    CHECK(soil.at(15, 15) == 0.3);
    CHECK(soil.at(4, 4) > 0.15);
    const double held = soil.stock.balance().added - 4 * 0.02 * 6;
    CHECK(held > 4 * 0.2);
    CHECK(soil.stock.balance().total == Approx(40 + 4 * 0.02 * 6 + held).epsilon(1e-12));
}

}  // namespace espalier::test
