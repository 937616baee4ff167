// Numbers that rise, such as times and heights of a table, and what lies between two of them.
#pragma once

#include <string>
#include <vector>

namespace espalier::environment {

/// Where a number lies among rising ones: behind `index`, by a share of the way to the next. Outside, at the end.
struct Between {
    std::size_t index;
    double share;
    bool is_outside;
};

Between find_between(const std::vector<double>& rising, double value);

/// Throws RunError if `time` lies outside `times`; a single one holds for ever. `name` is what has the times, `more`
/// what it needs more of.
void require_covered(const std::vector<double>& times, double time, const std::string& name, const char* more);

}  // namespace espalier::environment
