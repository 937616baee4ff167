// Asking a computation to end before it is done.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace espalier {

/// Thrown in the midst of work that was asked to end: what it was making is incomplete. It is no std::exception, so
/// that it is not taken for a mistake.
struct Stopped {};

/// Asks the work in its scope to end. Any thread may ask, and a signal handler may.
class StopRequest {
public:
    using Clock = std::chrono::steady_clock;

    /// Work ends before its next step, and in the midst of the step at hand if that is not done after so long.
    void ask(std::chrono::milliseconds patience = {}) noexcept { due_ = (Clock::now() + patience).time_since_epoch(); }
    void withdraw() noexcept { due_ = never; }

    /// Is it time to end between two steps?
    bool is_asked() const noexcept { return due_.load(std::memory_order_relaxed) != never; }
    /// Is it time to end in the midst of one?
    bool is_due() const noexcept {
        const Clock::duration due = due_.load(std::memory_order_relaxed);
        return due != never && Clock::now().time_since_epoch() >= due;
    }

    /// Returns the request for the work on this thread; null if the work cannot be stopped.
    static const StopRequest* current();

    /// While it lives, `request` (may be null) is that of the work on this thread.
    class Scope {
    public:
        explicit Scope(const StopRequest* request);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        const StopRequest* before_;
    };

private:
    static constexpr Clock::duration never = Clock::duration::max();
    static_assert(std::atomic<Clock::duration>::is_always_lock_free, "a signal handler touches lock-free atomics only");

    std::atomic<Clock::duration> due_{never};
};

/// How long a step may go on once its run was asked to end: most are done by then, and nothing is lost.
inline constexpr std::chrono::milliseconds patience_with_steps{400};

/// Throws Stopped if it is time to end in the midst of a step.
void end_if_asked();

/// For short turns of loops: calls end_if_asked() at every so many calls.
template <std::uint32_t calls>
class StopCheck {
public:
    void operator()() {
        if (++calls_ % calls == 0) end_if_asked();
    }

private:
    std::uint32_t calls_ = 0;
};

}  // namespace espalier
