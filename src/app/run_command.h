// What the command line asks of a run: commands that start runs share it.
#pragma once

#include "espalier/base/stop.h"
#include "espalier/simulation/simulation.h"

#include "base/platform.h"
#include "model_arguments.h"
#include "simulation/run/recorded_command.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace espalier::app {

struct RunArguments {
    ModelArguments model;
    KeyValues overrides;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
    int threads = 0;  ///< 0: as many as the machine has
    std::filesystem::path output;
    bool overwrite = false;
    bool goes_on = false;  ///< does what is left to do in `output`
    int checkpoint_every = 0;
    bool resume = false;  ///< goes on from the checkpoint in `output`
    std::size_t memory = 0;
    std::size_t disk = 0;  ///< bytes; 0: the default
    std::size_t blocks = 0, resident = 1;
    double timeout = -1;  ///< seconds that a process may take to answer in one step; 0: any time; below 0: the default
    bool quiet = false;
    bool json = false;
    std::function<void(const std::vector<Diagnostic>&, bool quiet)> warn = print_warnings;
    bool trust = false;  ///< the programs that the files name may be started
};
/// Takes the settings of a file that `espalier tree` writes, or of one of its presets, for the model, or the first
/// plant of the scene; what the arguments say themselves counts more. Throws UserError.
void take_settings(const std::filesystem::path& file, RunArguments& arguments);
/// The command line without what does not change the timeline: what starts the same run again.
std::vector<std::string> words_of(const RunArguments& arguments);

/// The folder of a run whose user named none: output/<scene>-<time>, numbered if two runs of a scene begin in the
/// same second. It is made at once, and removed in the end if nothing was written there.
class DefaultOutput {
public:
    explicit DefaultOutput(const std::string& scene);
    ~DefaultOutput();
    DefaultOutput(const DefaultOutput&) = delete;
    DefaultOutput& operator=(const DefaultOutput&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The scene that the arguments name, to be grown: the user has agreed to the programs that it starts. Throws
/// UserError.
Scene scene_of(const RunArguments& arguments);

/// The programs that a run of the arguments would start. Throws UserError.
std::vector<NamedProgram> programs_of(RunArguments arguments);

/// While it lives, the first Ctrl-C asks the work of this thread to end after the step at hand, or in its midst if that
/// lasts, and the second ends the program.
class InterruptibleRun {
public:
    explicit InterruptibleRun(bool quiet);

    static bool interrupted();

private:
    StopRequest::Scope scope_;
    platform::EndSignals signals_;
};

/// Grows the scene and records it in a folder, if one is named; progress and warnings go to standard error. `inputs` is
/// what was read. `recorder`, which may be null, sees every frame. `ranks`: the processes that do so together, or null.
RunResult grow(const RunArguments& arguments, const Scene& scene, const ReadLog& inputs,
               const std::filesystem::path& output, Recorder* recorder = nullptr, Ranks* ranks = nullptr);

/// Says that the run in a folder is complete, once for all ranks. Returns the exit code.
int tell_complete(const RecordedCommand& command, const std::filesystem::path& folder, bool quiet, bool json);

/// Runs it as `espalier run` does. Returns the exit code; throws UserError and RunError.
int run_command(const RunArguments& arguments);
/// What failed before the run: rethrows it, but of several ranks only one tells it, and all end.
int fail_to_run(const std::exception_ptr& error);

}  // namespace espalier::app
