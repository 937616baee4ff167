// Parameters that need no program: writes the lanes of a plan.
#pragma once

#include "lsystem/compile/compiled_model.h"

#include <cstddef>
#include <cstdint>

namespace espalier::lsystem {

/// Writes lanes in whole blocks; false if a value is not finite, which may be one of those that are too much.
inline bool write_lanes(const Plan& plan, const double* values, double* out) {
    const std::uint32_t* const sources = plan.lanes->sources.data();
    const double* const scales = plan.lanes->scales.data();
    const double* const offsets = plan.lanes->offsets.data();
    const auto lane = [&](std::size_t k) { return values[sources[k]] * scales[k] + offsets[k]; };
    static_assert(value_block == 4);
    double even = 0, odd = 0;  // differences of values to themselves: 0 as long as all are finite
    for (std::size_t k = 0; k < plan.parameters; k += value_block) {
        const double a = lane(k), b = lane(k + 1), c = lane(k + 2), d = lane(k + 3);
        out[k] = a;
        out[k + 1] = b;
        out[k + 2] = c;
        out[k + 3] = d;
        even += (a - a) + (c - c);
        odd += (b - b) + (d - d);
    }
    return even + odd == 0;
}

/// The same for one module's values alone; false if one of them is not finite.
inline bool write_lanes_exactly(const Lanes& lanes, std::size_t count, bool reads, const double* values, double* out) {
    static constexpr double none = 0;
    const double* const source = reads ? values : &none;
    bool finite = true;
    for (std::size_t k = 0; k < count; ++k) {
        const double value = source[lanes.sources[k]] * lanes.scales[k] + lanes.offsets[k];
        out[k] = value;
        finite &= value - value == 0;
    }
    return finite;
}

inline bool write_lanes_exactly(const CompiledProduction& production, const double* values, double* out) {
    const bool reads = std::any_of(production.strict.begin(), production.strict.end(),
                                   [](const CompiledPattern& pattern) { return pattern.arity > 0; });
    return write_lanes_exactly(production.lanes, production.parameters, reads, values, out);
}

}  // namespace espalier::lsystem
