// Ends the wait for a process that never answers.
#pragma once

#include "espalier/environment/environment.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace espalier::simulation {

/// While it lives, a thread looks at an environment, and calls `expired` once, on that thread, with the name of a
/// process that has been answering for longer than `seconds`.
class AnswerWatch {
public:
    AnswerWatch(const Environment& environment, double seconds, std::function<void(const std::string&)> expired);
    ~AnswerWatch();
    AnswerWatch(const AnswerWatch&) = delete;
    AnswerWatch& operator=(const AnswerWatch&) = delete;

private:
    void watch();
    bool ends_within(double seconds);

    const Environment& environment_;
    double seconds_;
    std::function<void(const std::string&)> expired_;
    std::mutex mutex_;
    std::condition_variable ends_;
    bool is_over_ = false;
    std::thread thread_;
};

}  // namespace espalier::simulation
