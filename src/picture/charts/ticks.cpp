#include "espalier/picture/chart_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::picture {
namespace {

/// The least of 1, 2, 5 times a power of ten that is no less than `least`.
double convenient_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    }
    return 10 * power;
}

std::string label_of(double value, double step) {
    struct Unit {
        double size;
        const char* name;
    };
    constexpr std::array<Unit, 3> units{{{1e9, "G"}, {1e6, "M"}, {1e3, "k"}}};
    if (std::abs(value) < step / 2) return "0";
    // Up to 9999 a number is read faster without a unit.
    const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& of) {
        return std::abs(value) >= of.size * (of.size < 1e4 ? 10 : 1) || (step >= of.size && std::abs(value) >= 10000);
    });
    const double shown = unit == units.end() ? value : value / unit->size;
    // As many digits as tell neighbours apart.
    const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(std::abs(value) / step))) + 1, 6, 15);
    return fmt::format("{:.{}g}{}", shown, digits, unit == units.end() ? "" : unit->name);
}

}  // namespace

Ticks ticks_over(double low, double high, int count) {
    Ticks ticks;
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) low = 0, high = 1;
    if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {  // one value: as if it began at 0
        const double value = high;
        low = std::min(value, 0.0);
        high = std::max(value, 0.0);
        if (low == high) high = 1;
    }
    const double step = convenient_step((high - low) / std::max(count, 1));
    const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
    ticks.low = first * step;
    ticks.high = last * step;
    for (double i = first; i <= last; ++i) {
        ticks.places.push_back(i * step);
        ticks.labels.push_back(label_of(i * step, step));
    }
    return ticks;
}

}  // namespace espalier::picture
