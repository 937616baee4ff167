// The world of a scene: its plants and its environment, one step at a time.
#pragma once

#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <vector>

namespace espalier {

class Timeline;

/// The folder of the model's file, where it reads files of its own.
std::filesystem::path folder_with(const Model& model);

/// Seconds spent per stage of the last step.
struct StageTimes {
    double derive = 0, interpret = 0, exchange = 0, record = 0;
};

class World {
public:
    /// Throws UserError for processes that cannot be made or queries nobody answers. What models write goes into
    /// `files`, below a folder of the plant's name if there are several; without it nothing is kept.
    World(const Scene& scene, std::size_t memory = std::size_t(-1), const std::filesystem::path& files = {});
    ~World();

    /// What recording takes counts against the memory, too. The timeline outlives the world's steps.
    void count_recording(const Timeline& timeline);
    /// How much of the memory is for frames that wait to be recorded.
    std::size_t bytes_for_frames() const;

    /// Frame 0: every axiom, interpreted and exchanged.
    void start();
    /// derive -> interpret -> exchange, for every plant; frame k is k steps.
    void step();

    /// Everything that lasts from step to step, as bytes, after a step; for this machine and the same scene.
    void save(std::ostream& out) const;
    /// Instead of start(): the next step() is the one after the save. The frame of the saved step is not there again.
    /// Throws RunError or UserError for bytes of another scene, or for bytes that are damaged.
    void restore(std::istream& in);

    // The parts of start() and step(), for who wants to see a string before its queries are answered.
    void plant_axioms();
    void derive();
    void exchange();

    int steps_done() const;
    /// Where the run ends: an animation's last frame, or the longest derivation length, which models may change.
    int last_step() const;
    bool stopped() const;  ///< a model called stop()
    std::size_t modules() const;
    const StageTimes& times() const;
    /// The frame of the current step; valid until the next.
    Frame frame() const;
    // Valid until the next step or frame().
    const ModuleString& string(std::size_t plant) const;
    const Interpretation& interpretation(std::size_t plant) const;
    const Model& model(std::size_t plant) const;
    const Environment& environment() const;
    /// What the processes passed over in their parameter files.
    const std::vector<Diagnostic>& warnings() const;
    std::size_t size() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace espalier
