// Threads that wait for work, so that a change does not begin with making one.
#pragma once

#include "studio/growth/piecewise_work.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace espalier::studio {

/// Some work, as those see it who have asked for it.
class RunningWork {
public:
    RunningWork() = default;
    explicit RunningWork(std::future<void> end) : end_(std::move(end)) {}

    bool has_ended() const { return end_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    /// For its end. Whatever it uses may go afterwards.
    void wait() { end_.wait(); }

private:
    std::future<void> end_;
};

class Workers {
public:
    Workers() = default;
    /// Waits for all work.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// On a thread that waits, or on a new one: it never waits for other work.
    RunningWork run(std::function<void()> work);
    /// The same; the work outlives its end.
    RunningWork run(PiecewiseWork& work);

private:
    void wait_for_work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::packaged_task<void()>> work_;
    std::size_t idle_ = 0;  ///< threads that wait
    bool ended_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace espalier::studio
