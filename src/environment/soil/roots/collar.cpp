#include "environment/soil/roots/collar.h"

#include "espalier/base/math.h"

#include "environment/soil/hydraulics/heads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::environment {
namespace {

/// The part of a day's transpiration that has passed since its midnight.
double passed_by(double day) {
    const double whole = std::floor(day), hour = day - whole;
    const double part = hour <= 0.25   ? 0
                        : hour >= 0.75 ? 1
                                       : 0.5 * (1 - math::cos(2 * std::numbers::pi * (hour - 0.25)));
    return whole + part;
}

}  // namespace

RootCollar RootCollar::read(const Settings& settings) {
    RootCollar collar;
    const Settings table = settings.table("collar");
    collar.held = table.has("head");
    if (int{collar.held} + int{table.has("transpiration")} + int{table.has("leaves")} != 1) {
        throw UserError(settings.place("collar"),
                        "'collar' needs one of 'head' (cm), 'transpiration' (cm3/d) and 'leaves' (a leaf-exchange)");
    }
    if (collar.held) {
        // Above 0, the plant would press water into the soil.
        collar.head = read_head_series(table, "head", Range::between(-1e6, 0));
        return collar;
    }
    collar.leaves = table.text_or("leaves", "");
    collar.limit = read_head_or(table, "limit", -15000, Range::between(-1e6, -1));
    if (!collar.leaves.empty()) return collar;
    collar.demand = TimeSeries::read(table, "transpiration", 0, Range::between(0, 1e9));
    collar.by_day = table.flag_or("by_day", false);
    return collar;
}

double RootCollar::mean_demand(double day, double days) const {
    const double potential = demand.at(day + 0.5 * days);
    if (!by_day) return potential;
    if (!(days > 0)) {
        const double height = math::sin(2 * std::numbers::pi * (day - std::floor(day) - 0.25));
        return potential * std::numbers::pi * std::max(0.0, height);
    }
    return potential * (passed_by(day + days) - passed_by(day)) / days;
}

double RootCollar::level(double day) const {
    if (held) return head.at(day);
    const double hour = day - std::floor(day);
    const bool dark = by_day && (hour < 0.25 - 1e-9 || hour >= 0.75 - 1e-9);
    return dark ? -1 : demand.at(day);
}

double RootCollar::longest_span(double day) const {
    const double change = std::min(demand.next_change(day), head.next_change(day)) - day;
    if (!by_day) return change;
    // Sunrise and sunset end a span; between them it is at most an hour.
    const double hour = day - std::floor(day);
    const double next = hour < 0.25 - 1e-9 ? 0.25 : hour < 0.75 - 1e-9 ? std::min(0.75, hour + 1.0 / 24) : 1.25;
    return std::min(change, next - hour);
}

}  // namespace espalier::environment
