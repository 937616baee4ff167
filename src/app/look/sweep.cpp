#include "sweep.h"

#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/simulation/simulation.h"

#include "app/child.h"
#include "app/command.h"
#include "app/temporary_folder.h"
#include "app/trust.h"
#include "base/csv_file.h"
#include "base/folder.h"
#include "base/platform.h"
#include "base/usable_memory.h"
#include "simulation/run/run_standing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <utility>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// What a run that failed said first, warnings and excerpts of files aside; "" if nothing.
std::string complaint(const fs::path& log) {
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line[0] != ' ' && line.find("warning:") == std::string::npos) return line;
    }
    return "";
}

bool is_done(const SweepRun& run) {
    return simulation::standing_of(run.folder, run.words).kind == RunStanding::Kind::complete;
}

// Runs at the same time leave a quarter of the memory to others; a single one has the half that every run has.
std::size_t share_of_memory(std::size_t runs) {
    return std::min(default_memory(), usable_memory() / 4 * 3 / std::max<std::size_t>(runs, 1));
}

/// The runs that go on at the moment, by their process numbers.
class RunPool {
public:
    /// `options`: of every run, besides its own.
    RunPool(const Sweep& sweep, std::size_t total, bool quiet, std::vector<std::string> options)
        : sweep_(sweep), options_(std::move(options)), total_(total), quiet_(quiet) {}

    std::size_t size() const { return running_.size(); }
    std::size_t failed() const { return failed_; }

    void start(const SweepRun& run) {
        make_folder_below(run.folder.parent_path(), run.folder.filename());
        const std::vector<std::string> command = sweep_.command(run);
        std::vector<std::string> arguments(command.begin() + 2, command.end());
        arguments.insert(arguments.end(), options_.begin(), options_.end());
        running_[start_run(arguments, fs::current_path(), sweep_.log(run))] = &run;
    }
    /// None is left behind, even where the next cannot be started.
    ~RunPool() {
        ask_to_end();
        for (const auto& entry : running_) platform::wait_for(entry.first);
    }
    RunPool(const RunPool&) = delete;
    RunPool& operator=(const RunPool&) = delete;

    /// Tells of those that have ended.
    void reap() {
        for (int child = 0, code = 0; (child = platform::poll(-1, code)) != 0;) {
            const auto place = running_.find(child);
            if (place == running_.end()) continue;
            tell(*place->second, code);
            running_.erase(place);
        }
    }
    void ask_to_end() const {
        for (const auto& entry : running_) platform::end(entry.first, platform::Ending::as_kill);
    }

private:
    void tell(const SweepRun& run, int code) {
        ++ended_;
        std::error_code ignored;
        if (code == 0 && fs::is_empty(sweep_.log(run), ignored)) fs::remove(sweep_.log(run), ignored);
        if (code != 0 && code != exit_code::interrupted) ++failed_;
        if (code != 0) {
            const std::string reason = complaint(sweep_.log(run));
            fmt::print(stderr, "{} of {}: {}: ended with code {}{}{}, see {}\n", ended_, total_, run.variant.name, code,
                       reason.empty() ? "" : ": ", reason, sweep_.log(run).string());
        } else if (!quiet_) {
            fmt::print(stderr, "{} of {}: {}\n", ended_, total_, run.variant.name);
        }
    }

    const Sweep& sweep_;
    std::vector<std::string> options_;
    std::map<int, const SweepRun*> running_;
    std::size_t total_, ended_ = 0, failed_ = 0;
    bool quiet_;
};

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

Sweep::Sweep(const RunArguments& base, const std::vector<Variation>& variations, const fs::path& folder)
    : base_(base), variations_(variations), folder_(folder) {
    for (Variant& variant : combine(variations)) {
        const RunArguments arguments = arguments_of(variant);
        const fs::path place = folder_ / (variant.name.empty() ? "run" : variant.name);
        runs_.push_back({std::move(variant), place, words_of(arguments)});
    }
}

RunArguments Sweep::arguments_of(const Variant& variant) const {
    RunArguments arguments = base_;
    const bool alone = !is_scene(base_.model.file);
    for (const auto& pair : variant.values) {
        const bool defines = alone && pair.first.find('.') == std::string::npos;
        (defines ? arguments.model.defines : arguments.overrides).push_back(pair);
    }
    return arguments;
}

void Sweep::agree_on_programs() {
    std::vector<NamedProgram> programs;
    try {
        programs = programs_of(arguments_of(runs_.front().variant));
    } catch (const UserError&) {
        return;  // the run itself will say what is wrong
    }
    require_trust(programs, base_.trust);
    base_.trust = !programs.empty();
}

RecordedTable Sweep::first_statistics() const {
    RunArguments arguments = arguments_of(runs_.front().variant);
    arguments.steps = 0;
    arguments.quiet = true;
    const TemporaryFolder folder("sweep");
    RunOptions options;
    options.output = folder.path() / "run";
    options.memory = base_.memory;
    try {
        espalier::run(scene_of(arguments), options);
        return RecordedRun(options.output).statistics();
    } catch (const std::exception&) {
        return {};  // the runs themselves will say what is wrong
    }
}

std::vector<const SweepRun*> Sweep::to_do() const {
    std::vector<const SweepRun*> left;
    for (const SweepRun& run : runs_) {
        if (!is_done(run)) left.push_back(&run);
    }
    return left;
}

std::vector<std::string> Sweep::command(const SweepRun& run) const {
    std::vector<std::string> words{platform::program_file().string(), "run"};
    words.insert(words.end(), run.words.begin(), run.words.end());
    words.insert(words.end(), {"--output", run.folder.string(), "--continue", "--overwrite"});
    if (base_.quiet) words.emplace_back("--quiet");
    if (base_.checkpoint_every > 0) {
        words.insert(words.end(), {"--checkpoint-every", std::to_string(base_.checkpoint_every)});
    }
    if (base_.threads > 0) words.insert(words.end(), {"--threads", std::to_string(base_.threads)});
    if (base_.memory > 0) words.insert(words.end(), {"--memory", std::to_string(base_.memory)});
    if (base_.disk > 0) words.insert(words.end(), {"--disk", std::to_string(base_.disk)});
    if (base_.trust) words.emplace_back("--trust");
    return words;
}

fs::path Sweep::log(const SweepRun& run) const {
    return run.folder.string() + ".log";
}

Sweep::Outcome Sweep::run(int jobs, bool quiet) const {
    const SignalCounter signals;
    const std::vector<const SweepRun*> left = to_do();
    if (!quiet && left.size() < runs_.size()) {
        fmt::print(stderr, "{} of {} runs are already complete\n", runs_.size() - left.size(), runs_.size());
    }
    if (!left.empty()) tell_warnings(*left.front(), quiet);
    RunPool pool(*this, left.size(), quiet, options_of_children(std::min(left.size(), static_cast<std::size_t>(jobs))));
    int passed_on = 0;
    for (std::size_t next = 0; pool.size() > 0 || (next < left.size() && signals.count() == 0);) {
        while (signals.count() == 0 && next < left.size() && pool.size() < static_cast<std::size_t>(jobs)) {
            pool.start(*left[next++]);
        }
        for (; passed_on < signals.count(); ++passed_on) pool.ask_to_end();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        pool.reap();
    }
    return {pool.failed(), signals.count() > 0};
}

std::vector<std::string> Sweep::options_of_children(std::size_t at_once) const {
    std::vector<std::string> options;
    if (!base_.quiet) options.emplace_back("--quiet");
    if (base_.memory == 0 && at_once > 1)
        options.insert(options.end(), {"--memory", std::to_string(share_of_memory(at_once))});
    return options;
}

// They are alike in all runs, whose own go to their logs.
void Sweep::tell_warnings(const SweepRun& run, bool quiet) const {
    RunArguments arguments = arguments_of(run.variant);
    arguments.quiet = true;
    try {
        print_warnings(scene_of(arguments).notes.diagnostics, quiet);
    } catch (const UserError&) {
        // The run itself will say what is wrong.
    }
}

std::string Sweep::state(const SweepRun& run) {
    using Kind = RunStanding::Kind;
    const RunStanding standing = simulation::standing_of(run.folder, run.words);
    if (standing.kind == Kind::absent) return "not begun";
    if (standing.kind == Kind::other) return fmt::format("another run is in {}: {}", run.folder.string(), standing.why);
    if (!standing.why.empty()) return standing.why;
    const std::string exit = exit_of_run(run.folder);
    const std::optional<int> step = step_of_checkpoint(run.folder);
    return step ? fmt::format("{}, with a checkpoint of step {}", exit, *step) : exit;
}

void Sweep::remove_old_complaints() const {
    std::error_code ignored;
    for (const SweepRun& run : runs_) {
        if (!complaint(log(run)).empty() && is_done(run)) fs::remove(log(run), ignored);
    }
}

std::vector<SweepResult> Sweep::results() const {
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

fs::path Sweep::write_table(const std::vector<SweepResult>& results) const {
    std::vector<std::string> columns;  // columns of all runs: those with other processes have other quantities
    for (const SweepResult& result : results) {
        for (const std::string& column : result.table.columns) {
            if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
        }
    }
    std::string text = "run";
    for (const auto& pair : runs_.front().variant.values) text += "," + csv_text(pair.first);
    text += ",name";
    for (const std::string& column : columns) text += "," + csv_text(column);
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

SweptRuns Sweep::drawn(const std::vector<SweepResult>& results) const {
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

}  // namespace espalier::app
