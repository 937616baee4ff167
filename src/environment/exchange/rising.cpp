#include "environment/exchange/rising.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {

Between find_between(const std::vector<double>& rising, double value) {
    const auto after = std::upper_bound(rising.begin(), rising.end(), value);
    if (after == rising.begin()) return {0, 0, value < rising.front()};
    const auto index = static_cast<std::size_t>(after - rising.begin()) - 1;
    if (after == rising.end()) return {index, 0, value > rising.back()};
    return {index, (value - rising[index]) / (*after - rising[index]), false};
}

void require_covered(const std::vector<double>& times, double time, const std::string& name, const char* more) {
    const double slack = 1e-9 * (1 + std::abs(time));
    const bool is_covered = times.front() - slack <= time && time <= times.back() + slack;
    if (times.size() < 2 || is_covered) return;
    throw RunError(fmt::format("{} goes from time {} to {}, but the run is at {}: give it more {}", name,
                               format_general(times.front()), format_general(times.back()), format_general(time),
                               more));
}

}  // namespace espalier::environment
