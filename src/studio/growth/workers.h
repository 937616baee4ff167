// Threads that wait for work, so that a change does not begin with making one.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace espalier::studio {

class Workers {
public:
    Workers() = default;
    /// Waits for all work.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// On a thread that waits, or on a new one: it never waits for other work.
    std::future<void> run(std::function<void()> work);

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
