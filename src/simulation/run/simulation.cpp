#include "espalier/simulation/simulation.h"

#include "espalier/base/file.h"
#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"
#include "espalier/simulation/world_checkpoint.h"
#include "espalier/timeline/timeline.h"

#include "base/bytes.h"
#include "base/reason.h"
#include "simulation/plant/memory_budget.h"
#include "simulation/run/disk_budget.h"
#include "simulation/run/run_record.h"
#include "simulation/run/run_standing.h"
#include "simulation/run/written_files.h"
#include "simulation/scene/expressions.h"
#include "simulation/world/answer_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace espalier::simulation {
namespace {

// Sealed files end with a digest of their bytes: what was damaged since is not taken for what was written.

// Returns the digest of the first `bytes` bytes, in pieces: the file may be larger than the memory.
std::optional<std::uint64_t> digest_of(std::istream& in, std::uintmax_t bytes) {
    char piece[65536];
    std::uint64_t sum = digest({});
    while (bytes > 0) {
        const std::size_t more = std::min<std::uintmax_t>(sizeof piece, bytes);
        if (!in.read(piece, static_cast<std::streamsize>(more))) return std::nullopt;
        sum = digest({piece, more}, sum);
        bytes -= more;
    }
    return sum;
}

/// Appends the digest; false if the file cannot be read or written.
bool seal(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) return false;
    std::ifstream in(path, std::ios::binary);
    const std::optional<std::uint64_t> sum = digest_of(in, bytes);
    if (!sum) return false;
    std::ofstream out(path, std::ios::binary | std::ios::app);
    put(out, *sum);
    return out.flush().good();
}

/// False for a file that was never sealed, or is another since.
bool is_sealed(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error || bytes < sizeof(std::uint64_t)) return false;
    std::ifstream in(path, std::ios::binary);
    const std::optional<std::uint64_t> sum = digest_of(in, bytes - sizeof(std::uint64_t));
    return sum && get<std::uint64_t>(in) == *sum;
}

constexpr std::uint64_t signature = 0x33'6e75'52'7370'61;  // "apsRun3"
constexpr std::uint64_t most_checkpoint_bytes = std::uint64_t{1} << 40;

class Run {
public:
    Run(const Scene& scene, const RunOptions& options)
        : scene_(scene), options_(options), world_(scene, world_options(options)), record_(world_, options) {
        warn();
        const bool records = is_first(options.ranks);
        together(options.ranks, [&] {
            if (!records) return help_to_record();
            if (!options.output.empty()) open_timeline();
            if (options.recorder) world_.attach(*options.recorder);
        });
        if (options.resume) restore();
    }

    RunResult walk() {
        bool cut_short = false;
        try {
            cut_short = !grow();
            together(options_.ranks, [&] {
                if (timeline_) timeline_->finish();
                if (options_.recorder && is_first(options_.ranks)) options_.recorder->finish();
            });
        } catch (const std::exception& error) {
            end_failed(reason_of(error));
            throw;
        }
        if (!cut_short) review();
        const std::string exit = cut_short ? "interrupted" : "done";
        write_record(exit);
        if (timeline_ && !cut_short) mark_complete(options_.output);
        return {record_.steps_done(),
                world_.last_step(),
                cut_short,
                world_.stopped(),
                world_.modules(),
                seconds(),
                peak_memory(),
                options_.recorder ? record_.json(exit, seconds()) : ""};
    }

private:
    static std::filesystem::path files_folder(const RunOptions& options) {
        return options.output.empty() ? std::filesystem::path() : files_folder_of(options.output);
    }

    static WorldOptions world_options(const RunOptions& options) {
        WorldOptions result;
        result.memory = options.memory;
        result.files = files_folder(options);
        result.ranks = options.ranks;
        result.is_looked_at = false;
        if (options.blocks == 0) return result;
        const auto folder = options.output.empty() ? std::filesystem::temp_directory_path() : options.output;
        result.blocks = {folder, options.blocks, options.resident};
        return result;
    }

    void review() {
        world_.review_run();
        warn();
    }

    // Tells the new warnings.
    void warn() {
        const std::vector<Diagnostic>& all = world_.warnings();
        if (options_.warn && all.size() > warned_) {
            options_.warn(explained({all.begin() + static_cast<std::ptrdiff_t>(warned_), all.end()}, scene_.computed));
        }
        warned_ = all.size();
    }

    // A mistake in the scene's [timeline] should not leave an empty folder behind.
    void open_timeline() {
        if (options_.resume) return resume_timeline();
        // An empty folder may have been made for this run.
        const bool existed = std::filesystem::exists(options_.output) && !std::filesystem::is_empty(options_.output);
        const auto files_before = files_before_run(options_.output);
        try {
            timeline_.emplace(options_.output, scene_.timeline, world_.last_step(), options_.overwrite);
        } catch (const UserError&) {
            if (!existed) remove_if_unused(options_.output);
            throw;
        }
        remove_checkpoint(options_.output);
        if (options_.overwrite) remove_old_run(files_before);
        record_.note_files_before(files_below(files_folder_of(options_.output)));
        begin_recording();
        record_.begin(*timeline_);
    }

    // Who is killed here leaves the run.json of a run that has begun and has no checkpoint: it says which files of the
    // models are to be removed, and never that something is complete.
    void remove_old_run(const std::optional<std::set<std::filesystem::path>>& files_before) {
        record_.note_files_before(files_before ? *files_before : files_below(files_folder_of(options_.output)));
        write_record("running");
        if (files_before) remove_written_files(options_.output, *files_before);
        timeline_->remove_old();
    }

    // The first rank records; the others write files of large frames for it.
    void help_to_record() {
        if (options_.output.empty()) return;
        of_pieces_ = recorder_of_pieces(options_.output, scene_.timeline, world_.last_step());
        if (of_pieces_) world_.attach(*of_pieces_);
    }

    void begin_recording() {
        if (scene_.frames) timeline_->choose(*scene_.frames);
        timeline_->keep_at_most(share_memory(options_.memory, world_.environment().memory_kept()).frames);
        world_.attach(*timeline_);
        disk_.emplace(options_.output, options_.disk, options_.resume);
        write_record("running");
    }

    void resume_timeline() {
        const std::filesystem::path path = checkpoint_of(options_.output);
        record_.note_files_before(files_before_run(options_.output).value_or(std::set<std::filesystem::path>{}));
        std::ifstream in(path, std::ios::binary);
        if (!in) throw UserError(fmt::format("there is no {} to go on from", path.string()));
        if (get<std::uint64_t>(in) != signature) throw RunError(fmt::format("{} is no checkpoint", path.string()));
        if (!is_sealed(path)) throw RunError(fmt::format("{} is damaged: it is not what was written", path.string()));
        timeline_.emplace(options_.output, scene_.timeline, world_.last_step(), get_text(in, most_checkpoint_bytes));
    }

    // Every rank reads the same file.
    void restore() {
        std::ifstream in;
        together(options_.ranks, [&] {
            in.open(checkpoint_of(options_.output), std::ios::binary);
            if (get<std::uint64_t>(in) != signature) throw RunError("the checkpoint is not there");
            get_text(in, most_checkpoint_bytes);  // of the timeline, which is resumed already
            record_.resume(timeline_ ? &*timeline_ : nullptr, in);
        });
        checkpoint_.restore(in);
        together(options_.ranks, [&] {
            if (timeline_) begin_recording();
        });
    }

    void write_checkpoint() {
        const double begin = seconds();
        checkpoint_.prepare(options_.output);
        together(options_.ranks, [&] {
            if (timeline_) write_own_checkpoint();
        });
        checkpoint_end_ = seconds();
        checkpoint_seconds_ = checkpoint_end_ - begin;
    }

    void write_own_checkpoint() {
        const StopRequest::Scope no_request(nullptr);
        std::ostringstream timeline;
        timeline_->save(timeline);
        write_file(checkpoint_of(options_.output), [&](const std::filesystem::path& temporary) {
            return save(temporary, timeline.str()) && seal(temporary);
        });
    }

    bool save(const std::filesystem::path& path, const std::string& timeline) const {
        std::ofstream out(path, std::ios::binary);
        put(out, signature);
        put_text(out, timeline);
        record_.save(out);
        checkpoint_.save(out);
        return out.flush().good();
    }

    static void remove_if_unused(const std::filesystem::path& folder) {
        std::error_code ignored;
        std::filesystem::remove(folder / ".lock", ignored);
        std::filesystem::remove(folder, ignored);  // does nothing unless empty
    }

    // False if it was asked to end before the last step.
    bool grow() {
        std::optional<AnswerWatch> watch;
        if (options_.patience > 0 && options_.expired && world_.environment().size() > 0) {
            watch.emplace(world_.environment(), options_.patience,
                          [this](const std::string& process) { give_up(process); });
        }
        try {
            if (!options_.resume) {
                world_.start();
                note_step();
            }
            while (!world_.at_end() && !is_asked_to_end()) advance();
        } catch (const Stopped&) {
            return false;  // the step at hand is dropped, and with it the state of the world
        }
        if (is_recorded_ && !world_.at_end()) {
            if (options_.saving) options_.saving(bytes_of_checkpoint());
            write_checkpoint();
        }
        return world_.at_end();
    }

    void advance() {
        world_.step();
        note_step();
        if (!is_recorded_ || world_.at_end()) return;
        const bool is_due = options_.checkpoint_every > 0 && world_.steps_done() % options_.checkpoint_every == 0;
        if (is_due || any(options_.ranks, timeline_ && is_worth_a_checkpoint())) write_checkpoint();
        check_disk();
    }

    // Who asks a run of long steps to end need not lose many of them, and who kills a run of short ones loses a minute.
    // The checkpoints take a small part of the time.
    bool is_worth_a_checkpoint() const {
        constexpr double part_of_the_time = 20;
        const StageTimes& last = world_.times();
        const std::chrono::duration<double> step(last.derive + last.interpret + last.exchange + last.record);
        const double since = seconds() - checkpoint_end_;
        if (step < patience_with_steps / 2 && since < options_.checkpoint_seconds) return false;
        return since >= part_of_the_time * checkpoint_seconds_.value_or(estimated_checkpoint());
    }

    // Seconds that writing it takes at least.
    double estimated_checkpoint() const {
        constexpr double bytes_per_second = 2e8;
        return static_cast<double>(bytes_of_checkpoint()) / bytes_per_second;
    }

    std::size_t bytes_of_checkpoint() const { return checkpoint_.bytes() + world_.environment().memory_kept(); }

    void check_disk() {
        if (!any(options_.ranks, disk_ && disk_->is_spent())) return;
        write_checkpoint();
        together(options_.ranks, [&] {
            if (disk_) refuse_disk();
        });
    }

    [[noreturn]] void refuse_disk() const {
        throw RunError(fmt::format(
            "step {}: the run has written {}, and --disk allows {}. All of it is whole; `espalier resume {} --disk "
            "SIZE` "
            "goes on",
            world_.steps_done(), size_text(disk_->written()), size_text(options_.disk), options_.output.string()));
    }

    void note_step() {
        record_.add_step(world_.times());
        warn();
        if (options_.progress)
            options_.progress({world_.steps_done(), world_.last_step(), world_.modules(), seconds()});
    }

    // What made the run fail is what the user must read; a disk too full to write it down is not.
    void end_failed(const std::string& why) {
        if (!timeline_) return;
        try {
            timeline_->finish();
        } catch (const std::exception&) {
        }
        try {
            write_record("failed: " + why);
        } catch (const std::exception&) {
        }
    }

    void give_up(const std::string& process) {
        const std::string why = fmt::format(
            "process '{}' has not answered the queries of a step for {} s; --timeout SECONDS gives it longer", process,
            options_.patience);
        try {
            write_record("failed: " + why);
        } catch (const std::exception&) {
        }
        options_.expired(why);
    }

    void write_record(const std::string& exit) {
        if (timeline_) record_.write(*timeline_, exit, seconds());
    }

    bool is_asked_to_end() const {
        const StopRequest* const request = StopRequest::current();
        return any(options_.ranks, request && request->is_asked());
    }
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    const Scene& scene_;
    const RunOptions& options_;
    World world_;
    WorldCheckpoint checkpoint_{world_};
    RunRecord record_;
    std::optional<Timeline> timeline_;
    std::unique_ptr<Recorder> of_pieces_;  ///< of a timeline that another rank has
    std::optional<DiskBudget> disk_;
    const bool is_recorded_ = !options_.output.empty();  ///< by the first rank
    std::size_t warned_ = 0;                             ///< how many of the world's warnings were told
    double checkpoint_end_ = 0;                          ///< seconds since the run began
    std::optional<double> checkpoint_seconds_;
};

// Ranks that grow different worlds would wait for each other for ever, or worse.
void require_same(const RunOptions& options) {
    if (!options.ranks) return;
    std::uint64_t inputs = digest(ESPALIER_VERSION);
    for (const std::string& argument : options.arguments) inputs = digest(argument, inputs);
    if (options.inputs) {
        for (const auto& file : options.inputs->files()) inputs = digest(std::to_string(file.second.digest), inputs);
    }
    const std::vector<std::string> all = from_all(options.ranks, std::to_string(inputs));
    together(options.ranks, [&] {
        const auto other = std::find_if(all.begin(), all.end(), [&](const std::string& one) { return one != all[0]; });
        if (other == all.end()) return;
        throw UserError(
            fmt::format("rank {} runs another version of the program, other files, or other arguments than "
                        "rank 0; all must see the same",
                        other - all.begin()));
    });
}

}  // namespace

std::filesystem::path checkpoint_of(const std::filesystem::path& output) {
    return output / "checkpoint";
}

std::optional<int> step_of_checkpoint(const std::filesystem::path& output) {
    try {
        std::ifstream in(checkpoint_of(output), std::ios::binary);
        if (!in || get<std::uint64_t>(in) != signature) return std::nullopt;
        get_text(in, most_checkpoint_bytes);  // of the timeline
        return RunRecord::step_saved_in(in);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

RunResult run(const Scene& scene, const RunOptions& options) {
    RunOptions resolved = options;
    if (resolved.memory == 0) resolved.memory = default_memory(ranks_on_node(options.ranks));
    if (resolved.disk == 0) resolved.disk = default_disk;
    require_same(resolved);
    return Run(scene, resolved).walk();
}

}  // namespace espalier::simulation
