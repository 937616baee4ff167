#include "studio/growth/printed_text.h"

#include <utility>

namespace espalier::studio {

std::shared_ptr<lsystem::Printout> PrintedText::printout() {
    return std::make_shared<lsystem::Printout>([this](const std::string& text) { add(text); });
}

void PrintedText::add(const std::string& text) {
    constexpr std::chrono::milliseconds between(200);
    const std::lock_guard lock(mutex_);
    unsent_ += text;
    if (std::chrono::steady_clock::now() - sent_ > between) send_locked();
}

void PrintedText::send() {
    const std::lock_guard lock(mutex_);
    send_locked();
}

void PrintedText::send_locked() {
    if (unsent_.empty()) return;
    sent_ = std::chrono::steady_clock::now();
    send_(std::exchange(unsent_, {}));
}

}  // namespace espalier::studio
