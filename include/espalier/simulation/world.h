// The world of a scene: its plants and its environment, one step at a time.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/ranks.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/recorder.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::simulation {

/// The folder of the model's file, where it reads files of its own.
std::filesystem::path folder_with(const Model& model);

/// Seconds spent per stage of the last step.
struct StageTimes {
    double derive = 0, interpret = 0, exchange = 0, record = 0;
    /// What this rank sent to others in the step; 0 without others.
    std::uint64_t messages = 0, bytes = 0;
};

/// The plants of each rank in `count` blocks, in the order of the scene: `resident` of them are in memory at once, the
/// others wait in an unlinked file in `folder`.
struct BlocksOnDisk {
    std::filesystem::path folder;         ///< must exist when the world starts
    std::size_t count = 1, resident = 1;  ///< at least 1
};

/// How a world is grown: nothing here changes a byte of what grows.
struct WorldOptions {
    std::size_t memory = std::size_t(-1);  ///< bytes for plants and fields
    /// What models write goes there, below a folder of the plant's name if there are several; empty: nothing is kept.
    std::filesystem::path files = {};
    std::shared_ptr<Printout> printout = nullptr;  ///< what models print; null: standard error
    /// The processes that grow the world together and all call start(), step(), review_run() and the functions of
    /// WorldCheckpoint; each holds some of the plants. They outlive the world. Null: it grows here alone.
    Ranks* ranks = nullptr;
    std::optional<BlocksOnDisk> blocks = {};  ///< none: all plants of this rank are in memory
    /// False: only recorders look at geometry and lineages. Where none does, they are not made, unless a process reads
    /// them or a model asks the turtle; frames have strings without lineage and empty interpretations.
    bool is_looked_at = true;
};

/// Worlds share nothing: several may grow at once, each on a thread of its own.
class World {
public:
    /// Throws UserError for processes that cannot be made, queries without a process, and processes that cannot see
    /// plants on other ranks or on disk.
    explicit World(const Scene& scene, const WorldOptions& options = {});

    /// The recorder sees the frames of every step from now on, and what it takes counts against the memory. It outlives
    /// the steps; after the last of them call its finish(). With ranks, before start(): the first rank has the
    /// recorders; on the others it gets the pieces that this rank writes of large frames (Frame::piece).
    void attach(Recorder& recorder);

    /// Frame 0: every axiom, interpreted, exchanged and recorded.
    void start();
    /// derive -> interpret -> exchange -> record, for every plant; frame k is k steps.
    void step();
    /// After the last step: adds to the warnings what only a whole run shows, such as models of which no plant has
    /// drawn anything. Of a run that went on from a checkpoint, it knows a part.
    void review_run();

    int steps_done() const;
    /// Where the run ends: the scene's last frame, or the longest derivation length, which models may change.
    int last_step() const;
    /// Stopped, or at the last step. Ask after every step.
    bool at_end() const;
    bool stopped() const;  ///< a model called stop()
    /// Of a plant, or of all of them on all ranks.
    std::size_t modules(std::optional<std::size_t> plant = {}) const;
    const StageTimes& times() const;

    /// The frame of the current step. Its fields are valid until the next. Plants that wait on disk or are on other
    /// ranks are empty there and in the next two, as between steps.
    Frame frame() const;
    // Valid until the next step.
    const ModuleString& string(std::size_t plant) const;
    const Interpretation& interpretation(std::size_t plant) const;
    const Model& model(std::size_t plant) const;
    const Environment& environment() const;

    /// The scene with what it left open decided: names, random streams, the values that processes use.
    const Scene& scene() const;
    /// What the processes ignored in their parameter files, processes that nothing asks, and what processes and turtles
    /// found in steps. It only grows.
    const std::vector<Diagnostic>& warnings() const;
    std::size_t size() const;  ///< number of plants

protected:
    struct State;
    struct DeleteState {
        void operator()(State* state) const;
    };
    friend class WorldCheckpoint;
    std::unique_ptr<State, DeleteState> state_;
};

}  // namespace espalier::simulation
