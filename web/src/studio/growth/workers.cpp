#include "studio/growth/workers.h"

namespace espalier::studio {
namespace {

using Then = PiecewiseWork::Then;

Workers* workers_of_page = nullptr;

}  // namespace

Workers::Workers() {
    workers_of_page = this;
}

Workers::~Workers() {
    workers_of_page = nullptr;
}

RunningWork Workers::add(std::function<Then()> next) {
    work_.push_back(std::make_shared<RunningWork::State>(RunningWork::State{std::move(next)}));
    return RunningWork(work_.back());
}

RunningWork Workers::run(std::function<void()> work) {
    return add([work = std::move(work)] {
        work();
        return Then::ended;
    });
}

RunningWork Workers::run(PiecewiseWork& work) {
    return add([&work] { return work.next(); });
}

bool Workers::take_turns() {
    return workers_of_page && workers_of_page->take_turn();
}

// Work may begin or end other work.
bool Workers::take_turn() {
    bool goes_on = false;
    const std::vector<std::shared_ptr<RunningWork::State>> all = work_;
    for (const auto& state : all) {
        if (state->has_ended) continue;
        const Then then = state->next();
        if (then == Then::ended) state->has_ended = true;
        goes_on = goes_on || then != Then::waits;
    }
    std::erase_if(work_, [](const auto& state) { return state->has_ended; });
    return goes_on;
}

}  // namespace espalier::studio
