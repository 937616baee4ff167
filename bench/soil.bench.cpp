// Water after Richards: rain on a block of soil, beside a plain column, and how the cost grows with the voxels. Water
// in a tree of roots. A solute that moves.
#include "espalier/environment/environment_process.h"

#include "environment/soil/richards/column.h"
#include "environment/soil/richards/reference.h"
#include "environment/soil/roots/hydraulic_tree.h"
#include "environment/soil/roots/uptake.h"
#include "table.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cmath>
#include <vector>

namespace espalier::bench {
namespace {

/// A quarter of a day of rain on loam that has a ball of sand, so that water flows across too.
void rain_on_block(benchmark::State& state, int edge) {
    const double size = 0.01 * edge;
    const std::string text = fmt::format(
        "domain = {{ lower = [0, {0}, 0], upper = [{1}, 0, {1}] }}\nvoxel = 0.01\nsoil = {2}\ninitial = {{ head = -400 "
        "}}\n"
        "regions = [{{ shape = \"sphere\", center = [{3}, {4}, {3}], radius = {5}, soil = \"sand\" }}]\n"
        "boundaries = {{ top = {{ rain = 100 }}, bottom = \"free-drainage\" }}",
        -size, size, test::test_loam, size / 2, -size / 2, size / 5);
    for (auto _ : state) {
        test::SoilBlock block(text);
        block.advance(0.25);
        benchmark::DoNotOptimize(block.soil.heads().data());
    }
    state.SetItemsProcessed(state.iterations() * edge * edge * edge);
}
void rain_on_small_block(benchmark::State& state) {
    rain_on_block(state, 20);
}
void rain_on_large_block(benchmark::State& state) {
    rain_on_block(state, 40);
}
BENCHMARK(rain_on_small_block)->UseRealTime();
BENCHMARK(rain_on_large_block)->UseRealTime();

/// Loam with a ball of clay over a closed floor, until it is full to the surface and a pond stands: per substep.
void filling(benchmark::State& state, double rain) {
    std::size_t substeps = 0;
    for (auto _ : state) {
        test::SoilBlock block(fmt::format(
            "domain = {{ lower = [0, -0.32, 0], upper = [0.32, 0, 0.32] }}\nvoxel = 0.01\nsoil = \"loam\"\n"
            "initial = {{ head = -500 }}\nregions = [{{ shape = \"sphere\", center = [0.2, -0.15, 0.2], radius = 0.08, "
            "soil = \"clay\" }}]\nboundaries = {{ top = {{ rain = {}, ponding = 20 }}, bottom = \"no-flux\" }}",
            rain));
        block.advance(0.3);
        substeps += block.soil.substeps();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(substeps) * 32 * 32 * 32);
}
void filling_with_rain(benchmark::State& state) {
    filling(state, 500);
}
void wetting_with_rain(benchmark::State& state) {
    filling(state, 10);
}
BENCHMARK(filling_with_rain)->UseRealTime();
BENCHMARK(wetting_with_rain)->UseRealTime();

/// Six days of rain that stands as a pond on loam of 200 layers over a closed floor, so many voxels wide and deep.
void pond(benchmark::State& state) {
    const double side = 0.02 * static_cast<double>(state.range(0));
    for (auto _ : state) {
        test::SoilBlock block(
            fmt::format("domain = {{ lower = [0, -4.0, 0], upper = [{0}, 0, {0}] }}\nvoxel = 0.02\nsoil = \"loam\"\n"
                        "initial = {{ head = -100 }}\nboundaries = {{ top = {{ rain = 20, ponding = 400 }}, bottom = "
                        "\"no-flux\" }}",
                        side));
        block.advance(6);
    }
}
BENCHMARK(pond)->Arg(1)->Arg(2)->UseRealTime();

/// The rain of the blocks on a column of the tests' reference, with as many cells as the small block is high.
void rain_on_plain_column(benchmark::State& state) {
    for (auto _ : state) {
        test::ReferenceColumn column({0.08, 0.43, 0.04, 1.6, 50}, 20, 20, -400);
        column.potential_flux = 10;
        column.free_drainage = true;
        column.advance(0.25, 50);
        benchmark::DoNotOptimize(column.h.data());
    }
    state.SetItemsProcessed(state.iterations() * 20);
}
BENCHMARK(rain_on_plain_column)->UseRealTime();

std::vector<environment::RootPiece> many_pieces() {
    std::vector<environment::RootPiece> pieces;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const std::uint32_t bearer = i == 0 ? environment::RootPiece::collar : i % 7 == 0 ? i / 2 : i - 1;
        pieces.push_back({bearer, 0.5, 0.2, 0.05, 1e-4, -200.0 - i % 100});
    }
    return pieces;
}

void tree_of_roots(benchmark::State& state) {
    const std::vector<environment::RootPiece> pieces = many_pieces();
    environment::HydraulicTree tree;
    environment::RootFlow flow;
    double seconds = 0;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        tree.look(pieces);
        tree.flow(pieces, -5000, flow);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        benchmark::DoNotOptimize(flow.transpiration);
    }
    state.counters["value"] = seconds / double(state.iterations()) / double(pieces.size()) * 1e9;
}
BENCHMARK(tree_of_roots)->UseRealTime();

void copy_of_roots(benchmark::State& state) {
    const std::vector<environment::RootPiece> pieces = many_pieces();
    std::vector<environment::RootPiece> copy(pieces.size());
    for (auto _ : state) {
        std::copy(pieces.begin(), pieces.end(), copy.begin());
        benchmark::ClobberMemory();
    }
}
BENCHMARK(copy_of_roots)->UseRealTime();

/// The same pieces in voxels of loam that dries: an evaluation, as a Newton step of the soil takes one.
void uptake_from_drying_soil(benchmark::State& state) {
    test::SoilBlock block(
        "domain = { lower = [0, -0.4, 0], upper = [0.4, 0, 0.4] }\nvoxel = 0.02\nsoil = \"loam\"\n"
        "initial = { head = -2000 }");
    environment::PlantRoots roots;
    roots.pieces = many_pieces();
    const std::size_t count = roots.pieces.size(), side = 20;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t voxel = i * 7919 % (side * side * side);
        roots.cells.push_back(block.grid.cell({int(voxel % side), int(voxel / side % side), int(voxel / side / side)}));
    }
    roots.radii.assign(count, 0.03);
    environment::PlantUptake uptake(std::move(roots), block.layout);
    environment::WaterBrick lengths(block.grid.cells(), 0.0);
    uptake.add_lengths(lengths);
    uptake.surround(lengths, true);
    std::vector<environment::SoilPoint> points(block.grid.cells());
    double drier = 0;  // cm
    for (auto _ : state) {
        state.PauseTiming();
        drier = std::fmod(drier + 1, 2000);
        for (std::size_t c = 0; c < points.size(); ++c) {
            points[c] = block.layout.kind(c).at(-2000 - drier - static_cast<double>(c * 7 % 400));
        }
        state.ResumeTiming();
        uptake.solve(points, environment::UptakeModel::network, {}, {}, 50, 0);
    }
}
BENCHMARK(uptake_from_drying_soil)->UseRealTime();

/// A step of Heun's on 64^3 voxels: a solute that flows and disperses.
void solute_in_block(benchmark::State& state) {
    Settings settings = Settings::parse_toml(
        "domain = { lower = [0, -0.64, 0], upper = [0.64, 0, 0.64] }\nvoxel = 0.01\ncontent = 0.3\nflow = 1\n"
        "dispersivity = 1\ninitial = 1\nboundaries = { top = { entering = 0 } }",
        "solute.toml");
    Fields fields;
    EnvironmentContext context;
    context.name = "nitrate";
    const auto process = registered<ProcessType>().at("nutrient")->make(settings, context, fields);
    WorldView world{1, 0, 0.02, {}};
    for (auto _ : state) process->advance(world, {}, fields);
    state.SetItemsProcessed(state.iterations() * 64 * 64 * 64);
}
BENCHMARK(solute_in_block)->UseRealTime();

void copy_of_a_solute(benchmark::State& state) {
    const std::vector<double> field(64 * 64 * 64, 1.0);
    std::vector<double> copy(field.size());
    for (auto _ : state) {
        std::copy(field.begin(), field.end(), copy.begin());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * 64 * 64 * 64);
}
BENCHMARK(copy_of_a_solute)->UseRealTime();

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row block{"a day of rain on 40^3 voxels of soil, per voxel, against a plain column of one dimension",
                "rain_on_large_block/real_time",
                "rain_on_plain_column/real_time",
                Measure::time_per_item,
                Goal::at_most,
                12};
const Row linear{"the same with eight times the voxels, per voxel",
                 "rain_on_large_block/real_time",
                 "rain_on_small_block/real_time",
                 Measure::time_per_item,
                 Goal::at_most,
                 1.5};

const Row full{"a substep of 32^3 voxels of loam that fills to a pond, against one of light rain",
               "filling_with_rain/real_time",
               "wetting_with_rain/real_time",
               Measure::time_per_item,
               Goal::at_most,
               3};

const Row narrow{"a pond on 2 x 200 x 2 voxels of soil, against one column",
                 "pond/2/real_time",
                 "pond/1/real_time",
                 Measure::time,
                 Goal::at_most,
                 5};

const Row tree{"water in a tree of 100,000 pieces of root, per piece, ns",
               "tree_of_roots/real_time",
               "",
               Measure::value,
               Goal::at_most,
               100};
const Row roots_copied{"the same, against copying the pieces",
                       "tree_of_roots/real_time",
                       "copy_of_roots/real_time",
                       Measure::time,
                       Goal::at_most,
                       60};
const Row evaluation{"the uptake of these pieces from soil that dries, against copying the pieces",
                     "uptake_from_drying_soil/real_time",
                     "copy_of_roots/real_time",
                     Measure::time,
                     Goal::at_most,
                     150};
const Row solute{"a step of a solute on 64^3 voxels, per voxel, against copying the field",
                 "solute_in_block/real_time",
                 "copy_of_a_solute/real_time",
                 Measure::time_per_item,
                 Goal::at_most,
                 2500};

}  // namespace
}  // namespace espalier::bench
