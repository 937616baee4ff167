// How often pages are told of what changes all the time.
#pragma once

#include <chrono>

namespace espalier::studio {

/// Lets through what is important, and all else at most 25 times a second.
class Pace {
public:
    bool lets_through(bool is_important) {
        const auto now = std::chrono::steady_clock::now();
        if (!is_important && now - last_ <= std::chrono::milliseconds(40)) return false;
        last_ = now;
        return true;
    }

private:
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace espalier::studio
