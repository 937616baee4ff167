// How a run is told of while it lasts: one living line on a terminal; in a pipe or a log about ten plain lines, or one
// a minute.
#pragma once

#include "espalier/simulation/simulation.h"

#include <chrono>

namespace espalier::app {

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
    int tenths_ = 0;
    double printed_seconds_ = 0;
    double last_seconds_ = 0;
    double step_seconds_ = 0;  ///< a moving average: later steps are longer, so the first ones should be forgotten
    double drawn_seconds_ = -1;
};

/// "3 s", "2 min 5 s", "1 h 12 min".
std::string duration_text(double seconds);
/// 1234567 as "1,234,567".
std::string grouped(std::size_t number);

}  // namespace espalier::app
