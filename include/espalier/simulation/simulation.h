// A run: a world stepped to its end, with its timeline.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/base/stations.h"
#include "espalier/simulation/world.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace espalier::simulation {

struct Progress {
    int step = 0, steps = 0;
    std::size_t modules = 0;
    double seconds = 0;  ///< since the run began
};

/// What the user asked of a run besides what it grows. It changes no byte of the timeline, and a run that goes on keeps
/// it. 0: nothing was asked, and the default holds.
struct AskedOptions {
    std::size_t memory = 0, disk = 0;      ///< bytes
    std::size_t blocks = 0, resident = 0;  ///< see RunOptions
    double patience = -1;                  ///< seconds, see RunOptions; below 0: nothing was asked
};

struct RunOptions {
    std::filesystem::path output;  ///< empty: no timeline
    Recorder* recorder = nullptr;  ///< sees every frame, besides the timeline if there is one; may be null
    bool overwrite = false;
    /// A checkpoint is written after every so many steps (0: as the next ones alone), before steps that last, when so
    /// many seconds have passed since the last one, and when the run is interrupted. Those that nobody asked for take a
    /// twentieth of the time at most.
    int checkpoint_every = 0;
    double checkpoint_seconds = 60;
    bool resume = false;     ///< goes on from the checkpoint in `output`
    std::size_t memory = 0;  ///< bytes; 0: default_memory()
    std::size_t disk = 0;    ///< bytes that may be written; 0: default_disk
    /// The plants of each rank in so many blocks, in the order of the scene, of which `resident` are in memory at once
    /// while the others wait on disk; 0: all are in memory. Changes no byte of the timeline.
    std::size_t blocks = 0, resident = 1;
    /// Seconds that a process may take to answer the queries of one step; 0: any time. A process cannot be stopped:
    /// `expired` is called on another thread, with what to tell the user, after run.json says how the run ended. It is
    /// to end the program; if it returns, the run goes on waiting.
    double patience = 0;
    std::function<void(const std::string& why)> expired = nullptr;
    /// The arguments of `espalier run` that change the timeline; for run.json.
    std::vector<std::string> arguments = {};
    AskedOptions asked = {};  ///< for run.json
    /// The processes that run the scene together, all of which call run() with the same options but for what is told:
    /// the first one records and is told of progress. Null: this one alone.
    Ranks* ranks = nullptr;
    /// What has been read so far and during the run; goes to run.json. Null: unknown.
    const ReadLog* inputs = nullptr;
    std::function<void(const Progress&)> progress = nullptr;
    /// Called before the checkpoint of an interrupted run is written, which takes about so many bytes.
    std::function<void(std::size_t bytes)> saving = nullptr;
    /// Called with the world's new warnings: before anything grows, after steps, and in the end.
    std::function<void(const std::vector<Diagnostic>&)> warn = nullptr;
};

struct RunResult {
    int steps = 0;
    int last_step = 0;  ///< where it was to end
    bool interrupted = false;
    bool stopped = false;  ///< a model called stop()
    std::size_t modules = 0;
    double seconds = 0;
    std::size_t peak_memory = 0;  ///< bytes
    std::string record = {};      ///< of a run with a recorder: what run.json says of it, or would say
};

/// The default of --memory: half of what this process may use of the machine (see base/usable_memory.h), divided among
/// so many processes that grow a world together there; in bytes.
std::size_t default_memory(std::size_t processes = 1);
/// The default of --disk, in bytes.
inline constexpr std::size_t default_disk = std::size_t{20} << 30;
/// The most memory this process ever held in the machine at once, in bytes.
std::size_t peak_memory();

/// The file in a run's folder that a later run goes on from; gone once the run has ended.
std::filesystem::path checkpoint_of(const std::filesystem::path& output);
/// The step from which that run goes on; nothing if there is no such file, or none that a run wrote.
std::optional<int> step_of_checkpoint(const std::filesystem::path& output);

/// Runs a scene to its end, or until the StopRequest in whose scope it works asks it to end: a step that is then not
/// done in time is dropped. A run that is interrupted or fails leaves its timeline whole up to the last step, with
/// run.json saying how it ended. One that has written as much as it may leaves a checkpoint, too. Throws UserError and
/// RunError; Stopped if it is asked to end before it has begun to write. A run that ends by itself has written the file
/// `complete` last of all.
RunResult run(const Scene& scene, const RunOptions& options = {});

}  // namespace espalier::simulation
