// How long work is told of: one living line on a terminal, nothing in a pipe.
#pragma once

#include "base/platform.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace espalier::app {

class LivingLine {
public:
    explicit LivingLine(bool quiet) : shown_(!quiet && platform::has_terminal()) {}
    ~LivingLine() { end(); }
    LivingLine(const LivingLine&) = delete;
    LivingLine& operator=(const LivingLine&) = delete;

    /// What `text()` gives, ten times a second at most, and at the last.
    template <class Text>
    void show(bool is_last, const Text& text) {
        const auto now = std::chrono::steady_clock::now();
        if (!shown_ || (!is_last && now - drawn_at_ < std::chrono::milliseconds(100))) return;
        drawn_at_ = now;
        drawn_ = true;
        fmt::print(stderr, "\r{}\033[K", text());
    }
    /// What is printed next begins on a line of its own.
    void end() {
        if (drawn_) fmt::print(stderr, "\n");
        drawn_ = false;
    }

private:
    bool shown_, drawn_ = false;
    std::chrono::steady_clock::time_point drawn_at_{};
};

}  // namespace espalier::app
