// The signals that ask a program to end: Ctrl-C, kill, and a terminal that is closed.
#pragma once

#include <array>
#include <csignal>

namespace espalier::app {

/// While it lives, a handler of its own answers them. A SIGHUP that `nohup` had made ignored stays so.
class EndSignals {
public:
    /// `only_once`: the second of a kind ends the program. Never of SIGHUP, which shell and terminal may both send.
    EndSignals(void (*handler)(int), bool only_once);
    ~EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

private:
    static constexpr std::array signals_{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals_.size()> before_{};
};

}  // namespace espalier::app
