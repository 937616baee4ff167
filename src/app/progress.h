// How a run is told of while it lasts: one living line on a terminal; in a pipe or a log about ten plain lines, or one
// a minute.
#pragma once

#include "espalier/simulation/simulation.h"

#include <chrono>

namespace espalier::app {

/// The steps of which a log tells: every tenth part of a run, and one a minute.
class LoggedSteps {
public:
    /// Whether this step is one.
    bool take(const Progress& progress) {
        constexpr double longest_silence = 60;
        if (progress.steps == 0) return false;
        const int tenths = static_cast<int>(10.0 * progress.step / progress.steps);
        if (tenths == tenths_ && progress.seconds - seconds_ < longest_silence) return false;
        tenths_ = tenths;
        seconds_ = progress.seconds;
        return true;
    }

private:
    int tenths_ = 0;
    double seconds_ = 0;
};

class ProgressReport {
public:
    explicit ProgressReport(bool quiet);
    /// Ends the living line, so that what is printed next begins on its own.
    ~ProgressReport();
    void operator()(const Progress& progress);

private:
    void redraw(const Progress& progress);
    void print_line(const Progress& progress);

    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    LoggedSteps logged_;
    double last_seconds_ = 0;
    double step_seconds_ = 0;  ///< a moving average: later steps are longer, so the first ones should be forgotten
    double drawn_seconds_ = -1;
};

/// "3 s", "2 min 5 s", "1 h 12 min".
std::string duration_text(double seconds);
/// 1234567 as "1,234,567".
std::string grouped(std::size_t number);

}  // namespace espalier::app
