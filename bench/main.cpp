// Runs the benchmarks, prints the table of goals and writes it as JSON. Exit code 1 if a goal is missed.
#include "table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <benchmark/benchmark.h>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

namespace espalier::bench {
namespace {

std::vector<Row>& registry() {
    static std::vector<Row> all;
    return all;
}

/// The best of a benchmark's repetitions: what disturbs a machine only ever slows it.
struct Best {
    double rate = 0;
    double seconds = 0;
    double value = std::numeric_limits<double>::infinity();
};

class Collector : public benchmark::ConsoleReporter {
public:
    Collector() : ConsoleReporter(OO_Tabular) {}

    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred || run.iterations == 0) continue;
            note(results_[run.run_name.str()], run);
        }
    }
    const Best* find(const std::string& name) const {
        const auto found = results_.find(name);
        return found == results_.end() ? nullptr : &found->second;
    }

private:
    static void note(Best& best, const Run& run) {
        const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
        if (best.seconds == 0 || seconds < best.seconds) best.seconds = seconds;
        const auto counter = [&](const char* name) {
            const auto found = run.counters.find(name);
            return found == run.counters.end() ? 0.0 : found->second.value;
        };
        best.rate = std::max(best.rate, counter("items_per_second"));
        const auto value = run.counters.find("value");
        if (value != run.counters.end()) best.value = std::min(best.value, value->second.value);
    }

    std::map<std::string, Best> results_;
};

std::optional<double> measured(const Row& row, const Collector& results) {
    const Best* work = results.find(row.work);
    if (!work) return std::nullopt;
    if (row.measure == Row::Measure::value) return work->value;
    const Best* yardstick = results.find(row.yardstick);
    if (!yardstick) return std::nullopt;
    return row.measure == Row::Measure::rate ? work->rate / yardstick->rate : work->seconds / yardstick->seconds;
}

/// Prints the lines that were measured; true if all of them reach their goals.
bool print_table(const Collector& results, const std::string& file) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    bool all = true;
    fmt::print("\n{:<64} {:>10} {:>12}  {}\n", "goal", "measured", "to reach", "verdict");
    for (const Row& row : rows()) {
        const std::optional<double> ratio = measured(row, results);
        if (!ratio) continue;
        const bool at_least = row.goal == Row::Goal::at_least;
        const bool reached = at_least ? *ratio >= row.limit : *ratio <= row.limit;
        all &= reached;
        fmt::print("{:<64} {:>10.3g} {:>3} {:>8.3g}  {}\n", row.title, *ratio, at_least ? ">=" : "<=", row.limit,
                   reached ? "reached" : "short");
        json.push_back({{"goal", row.title},
                        {"work", row.work},
                        {"yardstick", row.yardstick},
                        {"measured", *ratio},
                        {"bound", at_least ? "at least" : "at most"},
                        {"limit", row.limit},
                        {"verdict", reached ? "reached" : "short"}});
    }
    std::ofstream(file) << json.dump(2) << '\n';
    fmt::print("\nwritten to {}\n", file);
    return all;
}

}  // namespace

Row::Row(std::string title_, std::string work_, std::string yardstick_, Measure measure_, Goal goal_, double limit_)
    : title(std::move(title_)),
      work(std::move(work_)),
      yardstick(std::move(yardstick_)),
      measure(measure_),
      goal(goal_),
      limit(limit_) {
    registry().push_back(*this);
}

const std::vector<Row>& rows() {
    return registry();
}

}  // namespace espalier::bench

int main(int argc, char** argv) {
    using namespace espalier::bench;
    std::string file = "bench.json";
    std::vector<char*> arguments;
    for (int i = 0; i < argc; ++i) {
        if (std::string_view(argv[i]).starts_with("--json="))
            file = argv[i] + 7;
        else
            arguments.push_back(argv[i]);
    }
    // Three short repetitions say more than one long one; later options win over these.
    static char repetitions[] = "--benchmark_repetitions=3", short_runs[] = "--benchmark_min_time=0.3";
    arguments.insert(arguments.begin() + 1, {repetitions, short_runs});
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
    Collector results;
    benchmark::RunSpecifiedBenchmarks(&results);
    return print_table(results, file) ? 0 : 1;
}
