#include "environment/soil/hydraulics/steady_flux.h"

#include "environment/soil/hydraulics/bernoulli.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// Heads so near that the mean conductivity is that of the ends.
SoilFlux flux_down_near(const SoilPoint& upper, const SoilPoint& lower, double distance) {
    const double steepness = upper.conductivity > 0 ? upper.slope / upper.conductivity : 0;
    const double mean = 0.5 * (upper.conductivity + lower.conductivity);
    const double factor = mean / distance * bernoulli(steepness * distance).value;
    return {upper.conductivity - factor * (lower.head - upper.head), upper.slope + factor, -factor};
}

}  // namespace

SoilFlux flux_down(const SoilPoint& upper, const SoilPoint& lower, double distance) {
    const double rise = lower.head - upper.head;
    if (std::abs(rise) <= 1e-6 * (std::abs(upper.head) + std::abs(lower.head)) + 1e-9) {
        return flux_down_near(upper, lower, distance);
    }
    const double mean = (lower.potential - upper.potential) / rise;
    if (!(mean > 1e-200)) return {};
    // The steepness y / rise at which an exponential conductivity has this mean: K_upper / mean = B(y).
    const double ratio = upper.conductivity / mean;
    const ValueAndSlope y = inverse_bernoulli(ratio);
    const ValueAndSlope b = bernoulli(y.value * distance / rise);
    const double mean_by_upper = (mean - upper.conductivity) / rise, mean_by_lower = (lower.conductivity - mean) / rise;
    const double y_by_upper = y.slope * (upper.slope - ratio * mean_by_upper) / mean;
    const double y_by_lower = -y.slope * ratio * mean_by_lower / mean;
    const double turn = y.value / rise;
    const double by_upper =
        upper.slope + upper.conductivity * b.value / distance - mean * b.slope * (y_by_upper + turn);
    const double by_lower = -lower.conductivity * b.value / distance - mean * b.slope * (y_by_lower - turn);
    return {upper.conductivity - mean * rise / distance * b.value, by_upper, by_lower};
}

SoilFlux flux_across(const SoilPoint& first, const SoilPoint& second, double distance) {
    return {(first.potential - second.potential) / distance, first.conductivity / distance,
            -second.conductivity / distance};
}

SoilFlux flux_between_soils(const SoilHydraulics& first, const SoilPoint& a, const SoilHydraulics& second,
                            const SoilPoint& b, double distance, bool down) {
    const double half = 0.5 * distance;
    const auto flux = [&](const SoilPoint& from, const SoilPoint& to) {
        return down ? flux_down(from, to, half) : flux_across(from, to, half);
    };
    // Between the total heads of the ends, one half's flux falls with the head at the border and the other's rises.
    const double drop = down ? half : 0;
    double low = std::min(a.head + drop, b.head - drop), high = std::max(a.head + drop, b.head - drop);
    double head = 0.5 * (low + high);
    SoilFlux above, below;
    for (int i = 0; i < 80; ++i) {
        above = flux(a, first.at(head));
        below = flux(second.at(head), b);
        const double excess = above.flux - below.flux, slope = above.by_second - below.by_first;
        (excess > 0 ? low : high) = head;
        double next = slope < 0 ? head - excess / slope : low;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const double moved = std::abs(next - head);
        if (moved <= 1e-13 * (1 + std::abs(head))) break;
        head = next;
    }
    const double resistance = below.by_first - above.by_second;
    if (!(resistance > 0)) return {0.5 * (above.flux + below.flux), 0, 0};
    return {(above.flux * below.by_first - below.flux * above.by_second) / resistance,
            above.by_first * below.by_first / resistance, -above.by_second * below.by_second / resistance};
}

}  // namespace espalier::environment
