// What pages take of the processor beside the program, on one thread each: node runs the module that pages have.
#include "table.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace espalier::bench {
namespace {

const std::string in_node = ESPALIER_SOURCE_DIR "/build/web/growth_times.js";

struct Growths {
    std::string words;  ///< what tests/web/growth_times.cpp is asked
    int times = 1;
    bool first = false;  ///< of a process; otherwise the fastest, once the code is warm
};

/// Milliseconds of one growth. NaN if there is none.
double of_process(const std::string& program, const Growths& growths) {
    const std::size_t file = growths.words.rfind(' ') + 1;
    const std::string line = program + " " + growths.words.substr(0, file) + std::to_string(growths.times) + " '" +
                             ESPALIER_SOURCE_DIR "/" + growths.words.substr(file) + "'";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen(line.c_str(), "r"), pclose);
    double least = std::numeric_limits<double>::quiet_NaN(), one = 0;
    while (output && std::fscanf(output.get(), "%lf", &one) == 1) {
        least = std::fmin(least, one);
        if (growths.first) break;
    }
    return least;
}

void measure(benchmark::State& state, const Growths& growths) {
    constexpr int turns = 5;
    double web = std::numeric_limits<double>::quiet_NaN(), native = web;
    for (auto _ : state) {
        for (int turn = 0; turn < turns; ++turn) {
            web = std::fmin(web, of_process("node --no-experimental-fetch '" + in_node + "'", growths));
            native = std::fmin(native, of_process("'" ESPALIER_GROWTH_TIMES "'", growths));
        }
    }
    state.counters["work"] = web;
    state.counters["yardstick"] = native;
}

void plant_in_page(benchmark::State& state) {
    measure(state, {"derive 10 models/brackets/plant-f.l", 20});
}
BENCHMARK(plant_in_page)->UseRealTime()->Iterations(1);

void honda_in_page(benchmark::State& state) {
    measure(state, {"derive 17 models/trees/honda.l", 40});
}
BENCHMARK(honda_in_page)->UseRealTime()->Iterations(1);

void two_trees_in_page(benchmark::State& state) {
    measure(state, {"grow 60 environments/two-trees.toml", 40});
}
BENCHMARK(two_trees_in_page)->UseRealTime()->Iterations(1);

void first_two_trees_in_page(benchmark::State& state) {
    measure(state, {"grow 60 environments/two-trees.toml", 1, true});
}
BENCHMARK(first_two_trees_in_page)->UseRealTime()->Iterations(1);

void add_row(std::string title, const std::string& work, double limit) {
    Row(std::move(title), work + "/iterations:1/real_time", "", Row::Measure::counters, Row::Goal::at_most, limit);
}

const bool has_rows = [] {
    if (!std::filesystem::exists(in_node)) {
        leave_out("what grows in a page", "cmake --preset web && cmake --build --preset web --target growth_times");
        return false;
    }
    add_row("bare D0L plant derived in a page, processor time against the program's", "plant_in_page", 2.5);
    add_row("Honda's tree derived in a page, against the same", "honda_in_page", 2.5);
    add_row("two trees to step 60 in a page, against the same", "two_trees_in_page", 2.5);
    add_row("the first growth of those in a page, against the program's first", "first_two_trees_in_page", 4);
    return true;
}();

}  // namespace
}  // namespace espalier::bench
