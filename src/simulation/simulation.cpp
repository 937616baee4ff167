#include "espalier/simulation/simulation.h"

#include "run_record.h"

#include <chrono>
#include <exception>
#include <optional>

namespace espalier {
namespace {

class Run {
public:
    Run(const Scene& scene, const RunOptions& options)
        : scene_(scene),
          options_(options),
          world_(scene, options.memory, files_folder(options)),
          record_(scene, options) {
        if (options.warn) options.warn(world_.warnings());
        if (!options.output.empty()) open_timeline();
    }

    RunResult walk() {
        try {
            grow();
            if (timeline_) timeline_->finish();
        } catch (const std::exception& error) {
            end_failed(error.what());
            throw;
        }
        const bool cut_short = !at_end();
        write_record(cut_short ? "interrupted" : "done");
        return {world_.steps_done(), world_.last_step(), cut_short,    world_.stopped(),
                world_.modules(),    seconds(),          peak_memory()};
    }

private:
    static std::filesystem::path files_folder(const RunOptions& options) {
        return options.output.empty() ? std::filesystem::path() : options.output / "files";
    }

    // A mistake in the scene's [timeline] should not leave an empty folder behind.
    void open_timeline() {
        const bool existed = std::filesystem::exists(options_.output);
        try {
            timeline_.emplace(options_.output, scene_.timeline, scene_.steps, options_.overwrite);
        } catch (const UserError&) {
            if (!existed) remove_if_unused(options_.output);
            throw;
        }
        if (scene_.frames) timeline_->choose(*scene_.frames);
        write_record("running");
        record_.begin(*timeline_);
    }

    static void remove_if_unused(const std::filesystem::path& folder) {
        std::error_code ignored;
        std::filesystem::remove(folder / ".lock", ignored);
        std::filesystem::remove(folder, ignored);  // does nothing unless empty
    }

    void grow() {
        world_.start();
        record_frame();
        while (!at_end() && !interrupted()) {
            world_.step();
            record_frame();
        }
    }

    // Asked anew after every step: a model may stop, or change its derivation length.
    bool at_end() const { return world_.stopped() || world_.steps_done() >= world_.last_step(); }

    void record_frame() {
        StageTimes times = world_.times();
        const auto begin = std::chrono::steady_clock::now();
        if (timeline_) timeline_->record(world_.frame(), at_end());
        times.record = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        record_.add_step(times);
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

    void write_record(const std::string& exit) {
        if (timeline_) record_.write(*timeline_, world_, exit, seconds());
    }

    bool interrupted() const { return options_.interrupt && options_.interrupt->load(); }
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    const Scene& scene_;
    const RunOptions& options_;
    World world_;
    RunRecord record_;
    std::optional<Timeline> timeline_;
};

}  // namespace

RunResult run(const Scene& scene, const RunOptions& options) {
    RunOptions resolved = options;
    if (resolved.memory == 0) resolved.memory = default_memory();
    return Run(scene, resolved).walk();
}

}  // namespace espalier
