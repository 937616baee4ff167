// What Python costs: a process in Python beside the same in C++, and a recording through the module beside the program.
// bench/python.py measures both sides in turns.
#include "table.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace espalier::bench {
namespace {

void measure_in_python(benchmark::State& state, const std::string& work) {
    const std::string line = "PYTHONPATH='" ESPALIER_PYTHON_MODULES "' ESPALIER_PROGRAM='" ESPALIER_PROGRAM
                             "' '" ESPALIER_PYTHON "' '" ESPALIER_SOURCE_DIR "/bench/python.py' " +
                             work;
    double least = std::numeric_limits<double>::infinity(), yardstick = least;
    for (auto _ : state) {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen(line.c_str(), "r"), pclose);
        if (!output) throw std::runtime_error("Python does not start");
        double of_work = 0, of_yardstick = 0;
        while (std::fscanf(output.get(), "%lf %lf", &of_work, &of_yardstick) == 2) {
            least = std::min(least, of_work);
            yardstick = std::min(yardstick, of_yardstick);
        }
    }
    state.counters["work"] = least;
    state.counters["yardstick"] = yardstick;
}

void queries_to_python(benchmark::State& state) {
    measure_in_python(state, "queries");
}
BENCHMARK(queries_to_python)->UseRealTime()->Iterations(1);

void record_in_python(benchmark::State& state) {
    measure_in_python(state, "record");
}
BENCHMARK(record_in_python)->UseRealTime()->Iterations(1);

void internodes_to_numpy(benchmark::State& state) {
    measure_in_python(state, "views");
}
BENCHMARK(internodes_to_numpy)->UseRealTime()->Iterations(1);

void start_of_python(benchmark::State& state) {
    measure_in_python(state, "start");
}
BENCHMARK(start_of_python)->UseRealTime()->Iterations(1);

const Row start{"import espalier in a fresh Python, against import numpy, which it needs",
                "start_of_python/iterations:1/real_time",
                "",
                Row::Measure::counters,
                Row::Goal::at_most,
                2};
const Row queries{"exchange of 100,000 queries, a process in Python against the same in C++",
                  "queries_to_python/iterations:1/real_time",
                  "",
                  Row::Measure::counters,
                  Row::Goal::at_most,
                  4};
const Row views{"the tips of 100,000 internodes as an array of numpy, against copying them",
                "internodes_to_numpy/iterations:1/real_time",
                "",
                Row::Measure::counters,
                Row::Goal::at_most,
                0.1};
const Row recording_of_module{"es.record of a tree, against espalier run",
                              "record_in_python/iterations:1/real_time",
                              "",
                              Row::Measure::counters,
                              Row::Goal::at_most,
                              1.1};

}  // namespace
}  // namespace espalier::bench
