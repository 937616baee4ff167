// Grows a model or a scene again and again on one thread, and prints the processor time of each: compiled for this
// machine and for pages, its lines are what bench/web.bench.cpp compares.
//
//     growth_times derive|grow STEPS TIMES FILE     a line a growth, the first of which meets cold code: milliseconds
//     of all threads. `derive` is the string alone; `grow` begins with reading the file.
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/world.h"

#include "app/look/studio_documents.h"
#include "base/reason.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <span>
#include <string_view>
#include <utility>

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
// The clock of its C library is that of the wall, and the compiler of its machine code works on other threads.
EM_JS(double, processor_milliseconds, (), {
    const used = process.cpuUsage();
    return (used.user + used.system) / 1000;
});
#else
#include <tbb/global_control.h>
static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
static double processor_milliseconds() {
    return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
#endif

namespace espalier {
namespace {

/// Again and again in the memory of the time before.
class Deriving {
public:
    Deriving(const std::filesystem::path& file, int steps)
        : derivation_(plant_of_file(file, {}).model, {}), steps_(steps) {
        derivation_.set_length(steps);
    }

    void run() {
        derivation_.start(now_);
        for (int step = 0; step < steps_; ++step) {
            derivation_.step(now_, next_);
            std::swap(now_, next_);
        }
    }

private:
    Derivation derivation_;
    int steps_;
    ModuleString now_, next_;
};

void grow(const std::filesystem::path& file, int steps) {
    World world(app::read_opened({file, {}, {}}), {});
    world.start();
    while (world.steps_done() < steps && !world.at_end()) world.step();
}

void print_times(int times, const auto& work) {
    for (int i = 0; i < times; ++i) {
        const double begin = processor_milliseconds();
        work();
        fmt::print("{:.3f}\n", processor_milliseconds() - begin);
    }
}

void run(std::string_view what, int steps, int times, const std::filesystem::path& file) {
    if (what == "derive") {
        Deriving deriving(file, steps);
        print_times(times, [&] { deriving.run(); });
    } else {
        print_times(times, [&] { grow(file, steps); });
    }
}

}  // namespace
}  // namespace espalier

int main(int count, char** words) {
    const std::span arguments(words, static_cast<std::size_t>(count));
    if (count != 5) return 1;
    try {
        espalier::run(arguments[1], std::atoi(arguments[2]), std::atoi(arguments[3]),
                      std::filesystem::absolute(arguments[4]));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", espalier::reason_of(error));
        return 1;
    }
}
