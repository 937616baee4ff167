// The table of goals: every line is a benchmark beside its yardstick of the same run, and what their ratio must reach.
#pragma once

#include <string>
#include <vector>

namespace espalier::bench {

/// Defining one adds a line to the table. `work` and `yardstick` are names of benchmarks as they are printed.
struct Row {
    enum class Measure {
        rate,           ///< items per second of the work, divided by the yardstick's
        speedup,        ///< the same, 2 being what work that divides without loss gains from a second thread here
        time,           ///< seconds of the work, divided by the yardstick's
        time_per_item,  ///< seconds per item of the work, divided by the yardstick's
        value,          ///< the counter "value" of the work; no yardstick
        counters,       ///< the counter "work" of the work, divided by its counter "yardstick", each at its least
    };
    enum class Goal { at_least, at_most };

    Row(std::string title, std::string work, std::string yardstick, Measure measure, Goal goal, double limit);

    std::string title, work, yardstick;
    Measure measure;
    Goal goal;
    double limit;
};

/// Says in place of rows that they cannot be measured until `command` has been run.
void leave_out(const std::string& rows, const std::string& command);

/// In order of the files' names and of definition.
const std::vector<Row>& rows();

}  // namespace espalier::bench
