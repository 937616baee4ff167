// The world of a scene: its plants and its environment, one step at a time.
#pragma once

#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"

#include <memory>
#include <vector>

namespace espalier {

/// Seconds spent per stage of the last step.
struct StageTimes {
    double derive = 0, interpret = 0, exchange = 0, record = 0;
};

class World {
public:
    /// Throws UserError for processes that cannot be made or queries nobody answers.
    World(const Scene& scene, std::size_t memory = std::size_t(-1));
    ~World();

    /// Frame 0: every axiom, interpreted and exchanged.
    void start();
    /// derive -> interpret -> exchange, for every plant; frame k is k steps.
    void step();

    int steps_done() const;
    bool stopped() const;  ///< a model called stop()
    std::size_t modules() const;
    const StageTimes& times() const;
    /// The frame of the current step; valid until the next.
    Frame frame() const;
    const ModuleString& string(std::size_t plant) const;
    const Interpretation& interpretation(std::size_t plant) const;
    const Model& model(std::size_t plant) const;
    const Environment& environment() const;
    std::size_t size() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace espalier
