#include "measuring.h"

#include "espalier/base/random.h"
#include "espalier/simulation/simulation.h"

#include "growing.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

namespace espalier::bench {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Keeps what ran, and prints only what went wrong.
class Collector : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.error_occurred) GetErrorStream() << run.run_name.str() << ": " << run.error_message << '\n';
            if (run.run_type != Run::RT_Iteration || run.error_occurred || run.iterations == 0) continue;
            best_[run.run_name.str()].note(run);
        }
    }
    const Best& best(const std::string& name) { return best_[name]; }

private:
    std::map<std::string, Best> best_;
};

/// The same beside Google Benchmark's own table.
class LoudCollector : public benchmark::ConsoleReporter {
public:
    LoudCollector() : ConsoleReporter(OO_Tabular) {}

    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        quiet_.ReportRuns(runs);
    }
    const Best& best(const std::string& name) { return quiet_.best(name); }

private:
    Collector quiet_;
};

// Cores that share what they compute with, or with other machines, do not make two threads twice as fast.
const char* const divisible_on_one = "divisible/1/real_time";
const char* const divisible_on_two = "divisible/2/real_time";

void divisible(benchmark::State& state) {
    constexpr int parts = 64, length = 20'000;
    const tbb::global_control control = threads(state);
    for (auto _ : state) {
        tbb::parallel_for(
            0, parts,
            [](int part) {
                std::uint64_t value = std::uint64_t(part);
                for (int k = 0; k < length; ++k) value = mix(value);
                benchmark::DoNotOptimize(value);
            },
            tbb::simple_partitioner());
    }
    state.SetItemsProcessed(state.iterations() * parts);
}
BENCHMARK(divisible)->Arg(1)->Arg(2)->UseRealTime();

void run_benchmark(const std::string& name, Collector& collector) {
    std::string exactly = "^";
    for (const char c : name) {
        if (std::string_view(R"(.[]{}()*+?^$|\)").find(c) != std::string_view::npos) exactly += '\\';
        exactly += c;
    }
    try {
        benchmark::RunSpecifiedBenchmarks(&collector, exactly + "$");
    } catch (const std::exception& error) {  // its row is not measured; the others are
        fmt::print(stderr, "{}: {}\n", name, error.what());
    }
}

double counter(const std::map<std::string, double>& counters, const char* name) {
    const auto found = counters.find(name);
    return found == counters.end() ? nothing : found->second;
}

// Linux counts the peak anew after this; elsewhere it is the peak since the program began.
void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << 5;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void Best::note(const benchmark::BenchmarkReporter::Run& run) {
    const double taken = run.real_accumulated_time / static_cast<double>(run.iterations);
    seconds = repetitions == 0 ? taken : std::min(seconds, taken);
    ++repetitions;
    for (const auto& [name, value] : run.counters) {
        const auto [lowest, new_lowest] = least.emplace(name, value);
        if (!new_lowest) lowest->second = std::min(lowest->second, double(value));
        const auto [highest, new_highest] = most.emplace(name, value);
        if (!new_highest) highest->second = std::max(highest->second, double(value));
    }
    rate = most.contains("items_per_second") ? most["items_per_second"] : 0;
}

double Measured::figure() const {
    if (work.repetitions == 0) return nothing;
    switch (row->measure) {
        case Row::Measure::value:
            return counter(row->goal == Row::Goal::at_most ? work.least : work.most, "value");
        case Row::Measure::counters:
            return counter(work.least, "work") / counter(work.least, "yardstick");
        case Row::Measure::rate:
            return work.rate / (yardstick.repetitions == 0 ? nothing : yardstick.rate);
        case Row::Measure::speedup:
            if (yardstick.repetitions == 0 || divided.repetitions == 0) return nothing;
            return 2 * (work.rate / yardstick.rate) / (divided.rate / divisible.rate);
        case Row::Measure::time_per_item:
            return (yardstick.repetitions == 0 ? nothing : yardstick.rate) / work.rate;
        case Row::Measure::time:
            return work.seconds / (yardstick.repetitions == 0 ? nothing : yardstick.seconds);
    }
    return nothing;
}

bool Measured::reached() const {
    const double found = figure();
    return row->goal == Row::Goal::at_least ? found >= row->limit : found <= row->limit;
}

Measured measure(const Row& row, double seconds) {
    constexpr double noticeable = 0.01;
    constexpr int standstill = 4;
    forget_peak_memory();
    const auto begin = std::chrono::steady_clock::now();
    Collector collector;
    Measured measured{&row, {}, {}, {}, {}, 0};
    double fastest = 0, fastest_yardstick = 0;
    const auto improved = [](double& before, const Best& now) {
        const bool better = before == 0 || now.seconds < before * (1 - noticeable);
        if (better) before = now.seconds;
        return better;
    };
    for (int unchanged = 0; unchanged < standstill;) {
        run_benchmark(row.work, collector);
        if (!row.yardstick.empty()) run_benchmark(row.yardstick, collector);
        measured.work = collector.best(row.work);
        measured.yardstick = collector.best(row.yardstick);
        if (row.measure == Row::Measure::speedup) {
            run_benchmark(divisible_on_one, collector);
            run_benchmark(divisible_on_two, collector);
            measured.divisible = collector.best(divisible_on_one);
            measured.divided = collector.best(divisible_on_two);
        }
        const bool better_work = improved(fastest, measured.work);
        const bool better = improved(fastest_yardstick, measured.yardstick) || better_work;
        unchanged = better ? 0 : unchanged + 1;
        if (measured.work.repetitions == 0 || seconds_since(begin) > seconds) break;
    }
    measured.peak_memory = peak_memory();
    return measured;
}

std::vector<Measured> measure_chosen_by_google_benchmark() {
    LoudCollector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);
    std::vector<Measured> all;
    for (const Row& row : rows()) {
        const Measured measured{&row,
                                collector.best(row.work),
                                collector.best(row.yardstick),
                                collector.best(divisible_on_one),
                                collector.best(divisible_on_two),
                                peak_memory()};
        if (!std::isnan(measured.figure())) all.push_back(measured);
    }
    return all;
}

// glibc takes large blocks from the system and gives them back at once, until it has seen one freed; up to 32 MiB it
// keeps them from then on.
void warm_up_allocator() {
    for (std::size_t size = std::size_t(1) << 20; size <= (std::size_t(32) << 20); size *= 2) {
        std::vector<char> block(size - 4096, 1);
        benchmark::DoNotOptimize(block.data());
    }
}

}  // namespace espalier::bench
