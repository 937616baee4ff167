#include "study/sweep/swept_folder.h"

#include "espalier/base/file.h"
#include "espalier/simulation/simulation.h"

#include "base/csv_file.h"
#include "simulation/run/run_standing.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

bool is_done(const SweepRun& run) {
    return simulation::standing_of(run.folder, run.words).kind == RunStanding::Kind::complete;
}

// A row's cell for each of `columns`; empty where the table has none of that name.
std::string cells(const RecordedTable& table, const std::vector<double>& row, const std::vector<std::string>& columns) {
    std::string text;
    for (const std::string& column : columns) {
        const auto found = std::find(table.columns.begin(), table.columns.end(), column);
        text += ",";
        if (found != table.columns.end())
            text += csv_number(row[static_cast<std::size_t>(found - table.columns.begin())]);
    }
    return text;
}

// Keys that change together are drawn over the first of them, if that alone tells the runs apart.
std::string drawn_value(const Variation& variation, const Variant& variant, std::size_t at) {
    std::set<std::string> firsts;
    for (const std::vector<std::string>& values : variation.values) firsts.insert(values.front());
    std::string value = variant.values[at].second;
    if (firsts.size() == variation.values.size()) return value;
    for (std::size_t k = 1; k < variation.keys.size(); ++k) value += ":" + variant.values[at + k].second;
    return value;
}

}  // namespace

SweptFolder::SweptFolder(std::vector<Variation> variations, fs::path folder,
                         const std::function<std::vector<std::string>(const Variant&)>& words)
    : variations_(std::move(variations)), folder_(std::move(folder)) {
    for (Variant& variant : combine(variations_)) {
        std::vector<std::string> words_of_run = words(variant);
        const fs::path place = folder_ / (variant.name.empty() ? "run" : variant.name);
        runs_.push_back({std::move(variant), place, std::move(words_of_run)});
    }
}

std::vector<const SweepRun*> SweptFolder::to_do() const {
    std::vector<const SweepRun*> left;
    for (const SweepRun& run : runs_) {
        if (!is_done(run)) left.push_back(&run);
    }
    return left;
}

fs::path SweptFolder::log(const SweepRun& run) {
    return run.folder.string() + ".log";
}

std::string SweptFolder::complaint(const SweepRun& run) {
    std::ifstream in(log(run));
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line[0] != ' ' && line.find("warning:") == std::string::npos) return line;
    }
    return "";
}

std::string SweptFolder::state(const SweepRun& run) {
    using Kind = RunStanding::Kind;
    const RunStanding standing = simulation::standing_of(run.folder, run.words);
    if (standing.kind == Kind::absent) return "not begun";
    if (standing.kind == Kind::other) return fmt::format("another run is in {}: {}", run.folder.string(), standing.why);
    if (!standing.why.empty()) return standing.why;
    const std::string exit = exit_of_run(run.folder);
    const std::optional<int> step = step_of_checkpoint(run.folder);
    return step ? fmt::format("{}, with a checkpoint of step {}", exit, *step) : exit;
}

void SweptFolder::remove_old_complaints() const {
    std::error_code ignored;
    for (const SweepRun& run : runs_) {
        if (!complaint(run).empty() && is_done(run)) fs::remove(log(run), ignored);
    }
}

std::vector<SweepResult> SweptFolder::results() const {
    std::vector<SweepResult> results;
    for (const SweepRun& run : runs_) {
        if (!is_done(run)) continue;  // its last step is not the one asked for, or an older run's
        const RecordedRun recorded(run.folder);
        RecordedTable table = recorded.statistics();
        table.rows = table.last_rows();
        results.push_back({&run, std::move(table), recorded.plants()});
    }
    return results;
}

fs::path SweptFolder::write_table(const std::vector<SweepResult>& results) const {
    std::vector<std::string> columns;  // columns of all runs: those with other processes have other quantities
    for (const SweepResult& result : results) {
        for (const std::string& column : result.table.columns) {
            if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
        }
    }
    std::string text = "run";
    for (const auto& pair : runs_.front().variant.values) text.append(",").append(csv_text(pair.first));
    text += ",name";
    for (const std::string& column : columns) text.append(",").append(csv_text(column));
    text += "\n";
    for (const auto& [run, table, plants] : results) {
        std::string values = csv_text(run->variant.name);
        for (const auto& pair : run->variant.values) values.append(",").append(csv_text(pair.second));
        for (const std::vector<double>& row : table.rows) {
            const auto plant = static_cast<std::size_t>(row[table.column("plant")]);
            text += values + "," + csv_text(plants.at(plant).name) + cells(table, row, columns) + "\n";
        }
    }
    const fs::path path = folder_ / "sweep.csv";
    write_text(path, text);
    return path;
}

SweptRuns SweptFolder::drawn(const std::vector<SweepResult>& results) const {
    SweptRuns drawn;
    drawn.title = fs::absolute(folder_ / "").lexically_normal().parent_path().filename().string();
    for (const Variation& variation : variations_) drawn.keys.push_back(variation.keys.front());
    for (const SweepResult& result : results) {
        SweptRun& run = drawn.runs.emplace_back();
        std::size_t at = 0;
        for (const Variation& variation : variations_) {
            run.values.push_back(drawn_value(variation, result.run->variant, at));
            at += variation.keys.size();
        }
        run.table = result.table;
    }
    return drawn;
}

}  // namespace espalier::study
