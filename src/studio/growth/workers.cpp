#include "studio/growth/workers.h"

#include <utility>

namespace espalier::studio {

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        changed_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
}

RunningWork Workers::run(std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    std::future<void> end = work_.emplace_back(std::move(work)).get_future();
    if (idle_ < work_.size()) {
        threads_.emplace_back([this] { wait_for_work(); });
    } else {
        changed_.notify_one();
    }
    return RunningWork(std::move(end));
}

RunningWork Workers::run(PiecewiseWork& work) {
    using Then = PiecewiseWork::Then;
    return run([&work] {
        for (Then then = Then::goes_on; then != Then::ended; then = work.next()) {
            if (then == Then::waits) work.wait();
        }
    });
}

void Workers::wait_for_work() {
    std::unique_lock lock(mutex_);
    while (true) {
        ++idle_;
        changed_.wait(lock, [this] { return ended_ || !work_.empty(); });
        --idle_;
        if (work_.empty()) return;
        std::packaged_task<void()> work = std::move(work_.front());
        work_.pop_front();
        lock.unlock();
        work();
        lock.lock();
    }
}

}  // namespace espalier::studio
