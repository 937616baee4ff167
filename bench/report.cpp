#include "report.h"

#include "espalier/base/file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

namespace espalier::bench {
namespace {

using Json = nlohmann::ordered_json;

const char* sign(const Row& row) {
    return row.goal == Row::Goal::at_least ? ">=" : "<=";
}

const char* name_of(Row::Measure measure) {
    switch (measure) {
        case Row::Measure::rate:
            return "items per second, work over yardstick";
        case Row::Measure::speedup:
            return "items per second, work over yardstick; 2 is what work that divides without loss gains here";
        case Row::Measure::time:
            return "seconds, work over yardstick";
        case Row::Measure::time_per_item:
            return "seconds per item, work over yardstick";
        case Row::Measure::value:
            return "the benchmark's counter 'value'";
        case Row::Measure::counters:
            return "the benchmark's counters, 'work' over 'yardstick'";
    }
    return "";
}

const char* verdict(const Measured& measured) {
    if (std::isnan(measured.figure())) return "not measured";
    return measured.reached() ? "reached" : "short";
}

Json side_json(const std::string& name, const Best& best) {
    Json side = {{"benchmark", name}, {"repetitions", best.repetitions}, {"seconds", best.seconds}};
    if (best.rate > 0) side["items_per_second"] = best.rate;
    for (const auto& [counter, value] : best.least) {
        if (counter != "items_per_second") side[counter] = value;
    }
    return side;
}

Json row_json(const Measured& measured) {
    const Row& row = *measured.row;
    Json json = {{"goal", row.title},
                 {"measure", name_of(row.measure)},
                 {"measured", measured.figure()},
                 {"bound", row.goal == Row::Goal::at_least ? "at least" : "at most"},
                 {"limit", row.limit},
                 {"verdict", verdict(measured)},
                 {"work", side_json(row.work, measured.work)}};
    if (!row.yardstick.empty()) json["yardstick"] = side_json(row.yardstick, measured.yardstick);
    if (measured.divided.repetitions > 0) {
        json["divisible_work"] = {side_json("on one thread", measured.divisible),
                                  side_json("on two", measured.divided)};
    }
    json["peak_memory"] = measured.peak_memory;
    return json;
}

// What Linux calls the processor; empty elsewhere.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "";
}

Json machine_json() {
    const benchmark::CPUInfo& cpu = benchmark::CPUInfo::Get();
    Json caches = Json::array();
    for (const auto& cache : cpu.caches) {
        caches.push_back({{"level", cache.level}, {"type", cache.type}, {"bytes", cache.size}});
    }
    return {{"processor", processor()},
            {"cores", cpu.num_cpus},
            {"cycles_per_second", cpu.cycles_per_second},
            {"load_before", cpu.load_avg},
            {"caches", std::move(caches)}};
}

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown";
#endif
}

}  // namespace

void print_heading() {
    fmt::print("{:<66} {:>9} {:>11}  {:<8} {:>9}\n", "goal", "measured", "to reach", "verdict", "peak MiB");
    std::fflush(stdout);
}

void print_line(const Measured& measured) {
    const Row& row = *measured.row;
    fmt::print("{:<66} {:>9.3g} {:>2} {:>8.3g}  {:<8} {:>9}\n", row.title, measured.figure(), sign(row), row.limit,
               verdict(measured), measured.peak_memory >> 20);
    std::fflush(stdout);
}

void print_goals(const std::vector<const Row*>& chosen) {
    for (const Row* row : chosen) {
        fmt::print("{:<66} {} {:g}\n    {}\n    {}{}{}\n", row->title, sign(*row), row->limit, name_of(row->measure),
                   row->work, row->yardstick.empty() ? "" : "  beside  ", row->yardstick);
    }
}

void write_json(const std::vector<Measured>& all, double seconds, const std::filesystem::path& file) {
    Json json = {{"program", "espalier_bench"},
                 {"version", ESPALIER_VERSION},
                 {"written", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
                 {"machine", machine_json()},
                 {"compiler", compiler()},
                 {"seconds", seconds},
                 {"rows", Json::array()}};
    for (const Measured& measured : all) json["rows"].push_back(row_json(measured));
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    write_text(file, json.dump(2) + "\n");
}

}  // namespace espalier::bench
