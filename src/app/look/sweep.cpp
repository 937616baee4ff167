#include "sweep.h"

#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/simulation/simulation.h"

#include "app/child.h"
#include "app/command.h"
#include "app/temporary_folder.h"
#include "app/trust.h"
#include "base/folder.h"
#include "base/platform.h"
#include "base/usable_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>
#include <utility>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

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

    void start(const study::SweepRun& run) {
        make_folder_below(run.folder.parent_path(), run.folder.filename());
        const std::vector<std::string> command = sweep_.command(run);
        std::vector<std::string> arguments(command.begin() + 2, command.end());
        arguments.insert(arguments.end(), options_.begin(), options_.end());
        running_[start_run(arguments, fs::current_path(), study::SweptFolder::log(run))] = &run;
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
    void tell(const study::SweepRun& run, int code) {
        ++ended_;
        std::error_code ignored;
        if (code == 0 && fs::is_empty(study::SweptFolder::log(run), ignored))
            fs::remove(study::SweptFolder::log(run), ignored);
        if (code != 0 && code != exit_code::interrupted) ++failed_;
        if (code != 0) {
            const std::string reason = study::SweptFolder::complaint(run);
            fmt::print(stderr, "{} of {}: {}: ended with code {}{}{}, see {}\n", ended_, total_, run.variant.name, code,
                       reason.empty() ? "" : ": ", reason, study::SweptFolder::log(run).string());
        } else if (!quiet_) {
            fmt::print(stderr, "{} of {}: {}\n", ended_, total_, run.variant.name);
        }
    }

    const Sweep& sweep_;
    std::vector<std::string> options_;
    std::map<int, const study::SweepRun*> running_;
    std::size_t total_, ended_ = 0, failed_ = 0;
    bool quiet_;
};

}  // namespace

Sweep::Sweep(const RunArguments& base, const std::vector<Variation>& variations, const fs::path& folder)
    : base_(base),
      folder_(variations, folder, [&](const Variant& variant) { return words_of(arguments_of(variant)); }) {}

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
        programs = programs_of(arguments_of(folder_.runs().front().variant));
    } catch (const UserError&) {
        return;  // the run itself will say what is wrong
    }
    require_trust(programs, base_.trust);
    base_.trust = !programs.empty();
}

RecordedTable Sweep::first_statistics() const {
    RunArguments arguments = arguments_of(folder_.runs().front().variant);
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

std::vector<std::string> Sweep::command(const study::SweepRun& run) const {
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

Sweep::Outcome Sweep::run(int jobs, bool quiet) const {
    const SignalCounter signals;
    const std::vector<const study::SweepRun*> left = folder_.to_do();
    if (!quiet && left.size() < folder_.runs().size()) {
        fmt::print(stderr, "{} of {} runs are already complete\n", folder_.runs().size() - left.size(),
                   folder_.runs().size());
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
void Sweep::tell_warnings(const study::SweepRun& run, bool quiet) const {
    RunArguments arguments = arguments_of(run.variant);
    arguments.quiet = true;
    try {
        print_warnings(scene_of(arguments).notes.diagnostics, quiet);
    } catch (const UserError&) {
        // The run itself will say what is wrong.
    }
}

}  // namespace espalier::app
