// Leaves that exchange gas: side by side, beside a plain loop over the same solver written for one leaf.
#include "base/parallel.h"
#include "environment/leaf/gas/leaf_columns.h"
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
                       in(day->jmax), nullptr, nullptr, nullptr, out(0), out(1), out(2), out(3), out(4), out(5), out(6), nullptr,
                       out(7)});
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

using Measure = Row::Measure;
using Goal = Row::Goal;
const Row side_by_side{"gas exchange of 100,000 leaves in 24 hours, against a loop over the solver for one leaf",
                       "leaves_of_a_day/real_time",
                       "leaf_by_leaf/real_time",
                       Measure::rate,
                       Goal::at_least,
                       3};

}  // namespace
}  // namespace espalier::bench
