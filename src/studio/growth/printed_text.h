// What models print while they grow, on its way to pages.
#pragma once

#include "espalier/lsystem/printout.h"

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace espalier::studio {

/// Gathers what is printed, so that many small pieces are told as few.
class PrintedText {
public:
    using Send = std::function<void(std::string text)>;

    explicit PrintedText(Send tell) : send_(std::move(tell)) {}

    /// Where models print. It must not outlive this.
    std::shared_ptr<lsystem::Printout> printout();
    /// Tells what has not been told.
    void send();

private:
    void add(const std::string& text);
    void send_locked();

    const Send send_;
    std::mutex mutex_;
    std::string unsent_;
    std::chrono::steady_clock::time_point sent_{};
};

}  // namespace espalier::studio
