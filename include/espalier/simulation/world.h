// The world of a scene: its plants and its environment, one step at a time.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/ranks.h"
#include "espalier/simulation/scene.h"
#include "espalier/timeline/recorder.h"

#include <filesystem>
#include <iosfwd>
#include <memory>
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

/// What derivation leaves of a step: it can be drawn again, and gone on from.
struct DerivedStep {
    struct OfPlant {
        std::shared_ptr<const ModuleString> string;
        std::string memory;  ///< memory of the derivation, as bytes for this machine
    };
    int step = 0;
    std::vector<OfPlant> plants;
    std::uint64_t births = 0;  ///< modules that were born until then
};

/// Worlds share nothing: several may grow at once, each on a thread of its own.
class World {
public:
    /// `memory` in bytes. Throws UserError for processes that cannot be made or queries without a process. What models
    /// write goes into `files`, below a folder of the plant's name if there are several; without it nothing is kept.
    /// What they print goes to `printout`; null: standard error. `ranks`: the processes that grow the world together
    /// and all call start(), step(), prepare_save() and restore(); each holds some of the plants, and the first one has
    /// the recorders. They outlive the world; null: it grows here alone.
    explicit World(const Scene& scene, std::size_t memory = std::size_t(-1), const std::filesystem::path& files = {},
                   std::shared_ptr<Printout> printout = nullptr, Ranks* ranks = nullptr);
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// The recorder sees the frames of every step from now on, and what it takes counts against the memory. It outlives
    /// the steps; after the last of them call its finish().
    void attach(Recorder& recorder);
    /// On the other ranks: the recorder gets the pieces that this rank writes of large frames (Frame::piece).
    void attach_for_pieces(Recorder& recorder);

    /// Before start(): geometry and lineages will not be looked at. They are then not made, unless a process reads them
    /// or a model asks the turtle; frames have strings without lineage and empty interpretations.
    void skip_geometry();
    /// Before start() or restore(): in memory are at most so many plants at once; the others wait in a file in
    /// `folder`, which only this world sees, and recorders get the frames in parts. Changes no byte of what they
    /// write. Then the stages of a step may not be called one by one, and frame(), string() and interpretation() know
    /// nothing of plants that wait. After require_waiting().
    void keep_on_disk(const std::filesystem::path& folder, std::size_t in_memory);
    /// Throws UserError if plants cannot wait on disk: for processes that read whole plants, and with `ranks`.
    void require_waiting() const;
    /// Before start(): the derivation length of all plants, instead of the scene's.
    void set_steps(int steps);

    /// Frame 0: every axiom, interpreted, exchanged and recorded.
    void start();
    /// derive -> interpret -> exchange -> record, for every plant; frame k is k steps.
    void step();

    // The stages of start() and step(), to look at what one of them leaves.
    void write_axioms();
    void derive();
    void interpret();
    void exchange();
    void record();
    /// Answers what turtles answer themselves in an exchange: ?P, ?H, ?L, ?U.
    void answer_turtle_queries();

    /// After write_axioms() or derive().
    DerivedStep derived() const;
    /// Instead of write_axioms() or derive(): the world is as it was when `derived` was taken, of this scene or of one
    /// that derives alike. It can go on from there in scenes without processes whose plants neither ask nor grow anew
    /// in every step. Others have more to remember, see save(): they may only be interpreted.
    void take(const DerivedStep& derived);

    /// Before save(), on all ranks: the first one gets what the others hold, part by part, into a file without a name
    /// in `folder`. Without others, it does nothing. Throws RunError for a disk that is full.
    void prepare_save(const std::filesystem::path& folder);
    /// Everything that lasts from step to step, as bytes, after a step; for this machine and the same scene, and any
    /// number of ranks. Only on the first rank.
    void save(std::ostream& out) const;
    /// Instead of start(): the next step() is the one after the save. The frame of the saved step is not there again.
    /// Throws RunError or UserError for bytes of another scene, or for bytes that are damaged.
    void restore(std::istream& in);

    int steps_done() const;
    /// Where the run ends: the scene's last frame, or the longest derivation length, which models may change.
    int last_step() const;
    bool stopped() const;  ///< a model called stop()
    /// Stopped, or at the last step. Ask after every step.
    bool at_end() const;
    /// After the last step, on all ranks: adds to the warnings what only a whole run shows, such as models of which no
    /// plant has drawn anything. Not after restore(), which knows a part of the run.
    void review_run();
    std::size_t modules() const;
    std::size_t modules_of(std::size_t plant) const;
    std::size_t bytes_of_strings() const;  ///< of the plants that are here, in memory or on disk
    const StageTimes& times() const;
    /// The frame of the current step. Its fields are valid until the next.
    Frame frame() const;
    /// The same without what processes know: after take() they know nothing of the step.
    Frame frame_of_plants() const;
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

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace espalier::simulation
