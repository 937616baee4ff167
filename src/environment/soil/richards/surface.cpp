#include "environment/soil/richards/surface.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// More water than soil that is just full takes in: the depth at which what stands and what enters add up.
SurfaceExchange pond(const SoilHydraulics& soil, const SoilPoint& uppermost, double half, double available, double most,
                     double days) {
    const auto into = [&](double depth) { return flux_down(soil.at(depth), uppermost, half); };
    SurfaceExchange result;
    const SoilFlux at_most = into(most);
    if (most / days + at_most.flux <= available) {
        result.into = at_most;
        result.ponding = most;
        result.runoff = available - most / days - at_most.flux;
        return result;
    }
    double low = 0, high = most, depth = 0;
    SoilFlux flux;
    for (int i = 0; i < 60; ++i) {  // Newton between bounds
        flux = into(depth);
        const double excess = depth / days + flux.flux - available;
        (excess > 0 ? high : low) = depth;
        double next = depth - excess / (1 / days + std::max(flux.by_first, 0.0));
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const bool done = std::abs(next - depth) <= 1e-15 + 1e-13 * depth;
        depth = next;
        if (done) break;
    }
    result.ponding = depth;
    result.into.flux = available - depth / days;
    result.into.by_second = flux.by_second / (1 + days * std::max(flux.by_first, 0.0));
    return result;
}

}  // namespace

SurfaceExchange exchange_at_surface(const SoilHydraulics& soil, const SoilPoint& uppermost, double half,
                                    const SurfaceWeather& weather, double ponding, double days) {
    const double available = weather.rain - weather.evaporation + ponding / days;
    if (available > flux_down(soil.at(0), uppermost, half).flux) {
        SurfaceExchange result = pond(soil, uppermost, half, available, weather.most_ponding, days);
        result.evaporation = weather.evaporation;
        return result;
    }
    SurfaceExchange result{{available, 0, 0}, 0, weather.evaporation, 0};
    if (available >= 0) return result;
    SoilFlux least = flux_down(soil.at(weather.dry_limit), uppermost, half);
    if (least.flux > 0) least = {};  // soil drier than the limit draws no water from the air
    if (available < least.flux) {
        result.into = least;
        result.evaporation = weather.evaporation - (least.flux - available);
    }
    return result;
}

}  // namespace espalier::environment
