#include "studio/printed_text.h"

#include <utility>

namespace espalier::studio {

std::shared_ptr<lsystem::Printout> PrintedText::printout() {
    return std::make_shared<lsystem::Printout>([this](const std::string& text) { add(text); });
}

void PrintedText::add(const std::string& text) {
    constexpr std::chrono::milliseconds between(200);
    const std::lock_guard lock(mutex_);
    untold_ += text;
    if (std::chrono::steady_clock::now() - told_ > between) tell_locked();
}

void PrintedText::tell() {
    const std::lock_guard lock(mutex_);
    tell_locked();
}

void PrintedText::tell_locked() {
    if (untold_.empty()) return;
    told_ = std::chrono::steady_clock::now();
    tell_(std::exchange(untold_, {}));
}

}  // namespace espalier::studio
