#include "simulation/world/answer_watch.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace espalier::simulation {

AnswerWatch::AnswerWatch(const Environment& environment, double seconds,
                         std::function<void(const std::string&)> expired)
    : environment_(environment), seconds_(seconds), expired_(std::move(expired)), thread_([this] { watch(); }) {}

AnswerWatch::~AnswerWatch() {
    {
        const std::scoped_lock lock(mutex_);
        is_over_ = true;
    }
    ends_.notify_one();
    thread_.join();
}

void AnswerWatch::watch() {
    using Clock = std::chrono::steady_clock;
    std::uint64_t number = 0;
    Clock::time_point begin = Clock::now();
    while (!ends_within(std::min(seconds_ / 4, 1.0))) {
        const Environment::Consultation now = environment_.consultation();
        if (!now.process || now.number != number) {
            number = now.number;
            begin = Clock::now();
        } else if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds_) {
            return expired_(*now.process);
        }
    }
}

bool AnswerWatch::ends_within(double seconds) {
    std::unique_lock lock(mutex_);
    return ends_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_over_; });
}

}  // namespace espalier::simulation
