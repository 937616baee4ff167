// Wall time of some work.
#pragma once

#include <chrono>

namespace espalier::bench {

double seconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace espalier::bench
