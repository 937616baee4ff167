// Leaves that exchange gas: side by side, beside a plain loop over the same solver written for one leaf; and a plant
// whose soil, roots, stem and leaves are solved together, beside the same uncoupled.
#include "base/parallel.h"
#include "environment/exchange/exchange_plants.h"
#include "environment/leaf/gas/leaf_columns.h"
#include "environment/leaf/gas/leaf_water.h"
#include "environment/leaf/leaves/plant_leaves.h"
#include "table.h"

#include <tbb/global_control.h>

#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace espalier::bench {
namespace {

using namespace environment::leaf;

constexpr std::size_t leaves = 100'000;
constexpr int samples = 24;

/// A leaf of a canopy: what it gets of the light above, and the air of an hour.
struct Day {
    std::vector<double> share, photons, near_infrared, thermal, v, jmax;

    Day() : photons(leaves), near_infrared(leaves), thermal(leaves) {
        for (std::size_t i = 0; i < leaves; ++i) {
            const double depth = 3 * double(i * 7919 % leaves) / double(leaves);
            share.push_back(std::exp(-0.6 * depth) * (0.3 + 0.7 * double(i * 104729 % leaves) / double(leaves)));
            v.push_back(20 + 70 * std::exp(-0.3 * depth));
            jmax.push_back(1.9 * v.back());
        }
    }
    Air at(int hour) {
        const double rise = std::max(0.0, std::sin(std::numbers::pi * (hour - 5.5) / 13));
        const double temperature = 16 + 10 * std::sin(std::numbers::pi * (hour - 8.5) / 12);
        for (std::size_t i = 0; i < leaves; ++i) {
            photons[i] = 1700 * rise * share[i];
            near_infrared[i] = 0.25 * photons[i] / photons_of_joule;
            thermal[i] = 780;
        }
        return {temperature, 1.3, 1.2, 410, sea_level};
    }
};

struct Results {
    std::vector<double> columns[8];
    Results() {
        for (std::vector<double>& column : columns) column.resize(leaves);
    }
};

void leaves_side_by_side(benchmark::State& state, int threads) {
    const tbb::global_control width(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    const auto day = std::make_unique<Day>();
    Results all;
    for (auto _ : state) {
        for (int hour = 0; hour < samples; ++hour) {
            const Air air = day->at(hour);
            constexpr std::size_t piece = 1000;
            for_in_parallel(std::size_t{0}, leaves / piece, [&](std::size_t part) {
                const std::size_t first = part * piece;
                const auto in = [&](const std::vector<double>& of) { return of.data() + first; };
                const auto out = [&](int k) { return all.columns[k].data() + first; };
                solve({}, air,
                      {piece, in(day->photons), in(day->near_infrared), in(day->thermal), nullptr, in(day->v),
                       in(day->jmax), nullptr, nullptr, nullptr, out(0), out(1), out(2), out(3), out(4), out(5), out(6),
                       nullptr, out(7)});
            });
            benchmark::ClobberMemory();
        }
    }
    state.SetItemsProcessed(state.iterations() * leaves * samples);
}
void leaves_of_a_day(benchmark::State& state) {
    leaves_side_by_side(state, 1);
}
void leaves_of_a_day_on_two(benchmark::State& state) {
    leaves_side_by_side(state, 2);
}
BENCHMARK(leaves_of_a_day)->UseRealTime();
BENCHMARK(leaves_of_a_day_on_two)->UseRealTime();

void leaf_by_leaf(benchmark::State& state) {
    const auto day = std::make_unique<Day>();
    Results all;
    for (auto _ : state) {
        for (int hour = 0; hour < samples; ++hour) {
            const Air air = day->at(hour);
            for (std::size_t i = 0; i < leaves; ++i) {
                LeafKind leaf;
                leaf.photosynthesis.carboxylation.at_25 = day->v[i];
                leaf.photosynthesis.electron_transport.at_25 = day->jmax[i];
                const LeafLight light{day->photons[i], day->near_infrared[i], day->thermal[i]};
                const GasExchange found = gas_exchange(leaf, light, air);
                const double numbers[] = {found.assimilation, found.transpiration,
                                          found.conductance,  found.temperature,
                                          found.internal,     found.deficit,
                                          found.sent,         residuals_of(found, leaf, light, air).largest()};
                for (int k = 0; k < 8; ++k) all.columns[k][i] = numbers[k];
            }
            benchmark::ClobberMemory();
        }
    }
    state.SetItemsProcessed(state.iterations() * leaves * samples);
}
BENCHMARK(leaf_by_leaf)->UseRealTime();

/// All that is kept of a leaf which has parameters of its own, long waves and roots.
void memory_of_a_leaf(benchmark::State& state) {
    constexpr std::size_t count = 1000;
    double bytes = 0;
    for (auto _ : state) {
        PlantLeaves plant;
        for (std::uint32_t i = 0; i < count; ++i) plant.add(3 * i, 0, 1e-3F);
        for (auto* column : {&plant.lit, &plant.sunlit, &plant.sun_photons, &plant.shade_photons,
                             &plant.sun_near_infrared, &plant.shade_near_infrared, &plant.by_potential}) {
            column->assign(count, 0.5F);
        }
        for (std::vector<float>& column : plant.own) column.assign(count, 1);
        plant.thermal.assign(count, 700);
        plant.sent.assign(count, 700);
        plant.begin(-1);
        const std::size_t of_roots = sizeof(environment::DrawingLeaf) + 2 * sizeof(double);
        bytes = double(plant.bytes()) / double(count) + double(of_roots + sizeof(LeafRow));
        benchmark::DoNotOptimize(bytes);
    }
    state.counters["value"] = bytes;
}
BENCHMARK(memory_of_a_leaf)->UseRealTime();

/// A stem with 1,000 leaves, and 10,000 pieces of root in 32^3 voxels.
AskingPlants one_large_plant() {
    constexpr std::uint32_t internodes = 100, leaves_of_plant = 1000, taproot = 60, laterals = 780;
    AskingPlants plants;
    plants.add(std::vector<Asked>(internodes + leaves_of_plant + taproot + laterals, Asked{{0, 0, 0}, {0}}));
    PlantGeometry& geometry = plants.interpretation(0).geometry;
    const auto stand = [&](std::uint32_t module, std::uint32_t axis, const glm::dvec3& from, const glm::dvec3& to,
                           double radius) {
        geometry.internodes.push_back({module, axis, 0, 0, 0, from, to, radius, radius});
    };
    for (std::uint32_t i = 0; i < internodes; ++i) {
        stand(i, 0, {0, 0.01 * i, 0}, {0, 0.01 * (i + 1), 0}, 0.01);
    }
    for (std::uint32_t k = 0; k < leaves_of_plant; ++k) {
        const double turn = 2.4 * k, height = 0.01 * (k % internodes + 1), out = 0.05 + 2e-4 * k;
        const glm::dvec3 middle(out * std::cos(turn), height, out * std::sin(turn));
        Polygon polygon{};
        polygon.module = internodes + k;
        polygon.first = static_cast<std::uint32_t>(geometry.vertices.size());
        polygon.count = 4;
        for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            geometry.vertices.push_back(middle + glm::dvec3(0.02 * a, 0.004 * a, 0.02 * b));
        }
        geometry.polygons.push_back(polygon);
    }
    const std::uint32_t first_root = internodes + leaves_of_plant;
    for (std::uint32_t i = 0; i < taproot; ++i) {
        stand(first_root + i, 1, {0, -0.01 * i, 0}, {0, -0.01 * (i + 1), 0}, 0.005);
    }
    for (std::uint32_t k = 0; k < laterals; ++k) {
        const double turn = 2.4 * k, depth = -0.01 * (k % taproot + 1);
        stand(first_root + taproot + k, 2 + k, {0, depth, 0},
              {0.25 * std::cos(turn), depth - 0.02, 0.25 * std::sin(turn)}, 5e-4);
    }
    geometry.axes = 2 + laterals;
    return plants;
}

const std::string of_light =
    "[light]\nprocess = \"canopy-light\"\nvoxel = 0.1\nsky = { par = 1000, diffuse = 0.3, sun = [0, 1, 0] }\n";
const std::string of_soil =
    "[water]\nprocess = \"soil-water\"\nmodel = \"richards\"\ndomain = { lower = [-0.32, -0.64, -0.32], upper = "
    "[0.32, 0, 0.32] }\nvoxel = 0.02\nsoil = \"loam\"\ninitial = { head = -300 }\ndays = 0.0416666666666667\n";
const std::string of_roots = "[roots]\nprocess = \"root-water\"\nradial = 5e-3\naxial = 50\n";
const std::string of_leaves =
    "[leaves]\nprocess = \"leaf-exchange\"\nlight = \"light\"\nsf = 4\npsi_f = -1\ndays = 0.0416666666666667\n";

void hours_of(AskingPlants& plants, const std::string& tables) {
    EnvironmentContext context;
    context.domain = Box{{-0.32, 0, -0.32}, {0.32, 1.2, 0.32}};
    context.plants = 1;
    environment::Environment environment = environment_of(tables, context);
    environment.keep_unanswered();
    for (int hour = 0; hour <= 4; ++hour) plants.exchange(environment, hour);
    benchmark::DoNotOptimize(environment.statistic("leaves.water", 0));
}

void hours_of_a_plant(benchmark::State& state) {
    AskingPlants plants = one_large_plant();
    for (auto _ : state) {
        hours_of(plants, of_light + of_soil + of_roots + "stem = { conductivity = 2, b = 2.5, c = 3 }\n" + of_leaves +
                             "roots = \"roots\"\n");
    }
}
BENCHMARK(hours_of_a_plant)->UseRealTime();

/// Leaves of a given potential; and soil and roots from which about as much is drawn as the leaves above take.
void hours_of_its_parts(benchmark::State& state) {
    AskingPlants plants = one_large_plant();
    for (auto _ : state) {
        hours_of(plants, of_light + of_leaves);
        hours_of(plants, of_soil + of_roots + "collar = { transpiration = 600, limit = -15000 }\n");
    }
}
BENCHMARK(hours_of_its_parts)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row side_by_side{"gas exchange of 100,000 leaves in 24 hours, against a loop over the solver for one leaf",
                       "leaves_of_a_day/real_time",
                       "leaf_by_leaf/real_time",
                       Measure::rate,
                       Goal::at_least,
                       3};
const Row on_two{"the same, with a second thread",
                 "leaves_of_a_day_on_two/real_time",
                 "leaves_of_a_day/real_time",
                 Measure::speedup,
                 Goal::at_least,
                 1.8};
const Row kept{"what is kept of a leaf that has all that a leaf may have, bytes",
               "memory_of_a_leaf/real_time",
               "",
               Measure::value,
               Goal::at_most,
               200};
const Row coupled{
    "four hours of 1,000 leaves, 10,000 pieces of root and 32^3 voxels of soil, against its parts uncoupled",
    "hours_of_a_plant/real_time",
    "hours_of_its_parts/real_time",
    Measure::time,
    Goal::at_most,
    1.5};

}  // namespace
}  // namespace espalier::bench
