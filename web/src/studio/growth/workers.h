// Work of a page's worker, which has one thread: all who work take turns between two messages.
#pragma once

#include "studio/growth/piecewise_work.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace espalier::studio {

/// Some work, as those see it who have asked for it.
class RunningWork {
public:
    struct State {
        std::function<PiecewiseWork::Then()> next;
        bool has_ended = false;
    };

    RunningWork() = default;
    explicit RunningWork(std::shared_ptr<State> state) : state_(std::move(state)) {}

    bool has_ended() const { return state_->has_ended; }
    /// Nothing runs while another does, so it ends here.
    void wait() { state_->has_ended = true; }

private:
    std::shared_ptr<State> state_;
};

class Workers {
public:
    Workers();
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    RunningWork run(std::function<void()> work);
    RunningWork run(PiecewiseWork& work);

    /// A piece of each work. False if all wait.
    static bool take_turns();

private:
    RunningWork add(std::function<PiecewiseWork::Then()> next);
    bool take_turn();

    std::vector<std::shared_ptr<RunningWork::State>> work_;
};

}  // namespace espalier::studio
