// Measures the table of goals, prints it and writes it as JSON. Exit code 1 if a goal is missed, 2 for mistakes.
#include "base/platform.h"
#include "report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace espalier::bench {
namespace {

std::vector<Row>& registry() {
    static std::vector<Row> all;
    return all;
}

std::vector<std::string>& left_out() {
    static std::vector<std::string> all;
    return all;
}

struct Arguments {
    bool list = false;
    std::vector<std::string> rows;
    double seconds = 6;
    std::string json = "output/bench.json";
    std::vector<std::string> passed_on;  ///< --benchmark_...
};

const char* const description =
    "Measures how fast Espalier is, as ratios that mean the same on every machine.\n\n"
    "Each line of the table is some work beside a yardstick: plain C++ for the same rule, a bare scan, a copy of the\n"
    "memory, or the same work without what is being judged. The two are run in turns, each counts at its best, so "
    "that\n"
    "other programs on the machine disturb the ratio little. 'reached' or 'short' says whether the goal is met; the "
    "exit\n"
    "code is 1 if one is short. docs/developer/performance.md has the last results.";

const char* const examples =
    "Examples:\n"
    "  espalier_bench                    all rows, in five to six minutes\n"
    "  espalier_bench --list             the rows, what they measure, and their goals\n"
    "  espalier_bench --row context      the rows with that word, in any case\n"
    "  espalier_bench --row forest --seconds 60\n"
    "  espalier_bench --benchmark_filter=honda --benchmark_repetitions=15 --benchmark_min_time=0.02\n"
    "                                    single benchmarks in Google Benchmark's way, and the rows they fill\n";

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool matches(const Row& row, const std::vector<std::string>& words) {
    const std::string text = lower(row.title + '\n' + row.work + '\n' + row.yardstick);
    return words.empty() || std::any_of(words.begin(), words.end(),
                                        [&](const std::string& word) { return text.find(lower(word)) != text.npos; });
}

std::vector<const Row*> chosen_rows(const std::vector<std::string>& words) {
    std::vector<const Row*> chosen;
    for (const Row& row : rows()) {
        if (matches(row, words)) chosen.push_back(&row);
    }
    return chosen;
}

void initialize(std::vector<std::string> options) {
    // Many short repetitions say more than a few long ones; the user's options come later and win.
    options.insert(options.begin(), {"espalier_bench", "--benchmark_min_time=0.05"});
    std::vector<char*> pointers;
    for (std::string& option : options) pointers.push_back(option.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) std::exit(2);
}

std::vector<Measured> measure_all(const Arguments& arguments, const std::vector<const Row*>& chosen) {
    if (!arguments.passed_on.empty()) {
        const std::vector<Measured> all = measure_chosen_by_google_benchmark();
        fmt::print("\n");
        print_heading();
        for (const Measured& measured : all) print_line(measured);
        return all;
    }
    std::vector<Measured> all;
    print_heading();
    for (const Row* row : chosen) print_line(all.emplace_back(measure(*row, arguments.seconds)));
    return all;
}

/// In memory where there is some: a disk on which row after row has just removed thousands of files makes new ones so
/// slowly that nothing else is measured. TMPDIR names another place.
void choose_folder_of_recordings() {
    std::error_code ignored;
    if (std::filesystem::is_directory("/dev/shm", ignored)) setenv("TMPDIR", "/dev/shm", /*replace=*/0);
}

void print_left_out() {
    for (const std::string& line : left_out()) fmt::print("{}\n", line);
}

int run(const Arguments& arguments) {
    const std::vector<const Row*> chosen = chosen_rows(arguments.rows);
    if (chosen.empty()) {
        print_left_out();
        fmt::print(stderr, "no row of the table matches; --list shows them all\n");
        return 2;
    }
    if (arguments.list) {
        print_goals(chosen);
        print_left_out();
        return 0;
    }
    const auto begin = std::chrono::steady_clock::now();
    choose_folder_of_recordings();
    initialize(arguments.passed_on);
    warm_up_allocator();
    const std::vector<Measured> all = measure_all(arguments, chosen);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    print_left_out();
    write_json(all, seconds, arguments.json);
    const auto reached = std::count_if(all.begin(), all.end(), [](const Measured& one) { return one.reached(); });
    fmt::print("\n{} of {} goals reached, in {:.0f} s; written to {}\n", reached, all.size(), seconds, arguments.json);
    return reached == static_cast<std::ptrdiff_t>(all.size()) ? 0 : 1;
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

void leave_out(const std::string& rows, const std::string& command) {
    left_out().push_back(fmt::format("left out: {}, until it is built: {}", rows, command));
}

const std::vector<Row>& rows() {
    return registry();
}

}  // namespace espalier::bench

int main(int argc, char** argv) {
    using namespace espalier::bench;
    Arguments arguments;
    CLI::App app(description, "espalier_bench");
    app.footer(examples);
    app.allow_extras();
    app.add_flag("--list", arguments.list, "Print the rows and their goals, and measure nothing");
    app.add_option("--row", arguments.rows, "Only rows with this text in their goal or benchmarks; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--seconds", arguments.seconds, "How long a row is repeated, unless its bests stand still before")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 3600.0));
    app.add_option("--json", arguments.json, "Where the result is written")->capture_default_str();
    espalier::platform::give_back_large_blocks();  // as the program does
    try {
        app.parse(argc, argv);
        arguments.passed_on = app.remaining();
        return run(arguments);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
