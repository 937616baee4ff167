#include "environment/given/weather/thermal_time.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

double ThermalTime::at(double temperature) const {
    if (temperature <= base || temperature >= ceiling) return 0;
    if (temperature <= optimum) return temperature - base;
    if (!std::isfinite(ceiling)) return optimum - base;
    return (optimum - base) * (ceiling - temperature) / (ceiling - optimum);
}

/// Of `at`, from the base.
double ThermalTime::integral_to(double temperature) const {
    const double rising = std::clamp(temperature, base, optimum) - base;
    double sum = rising * rising / 2;
    if (temperature <= optimum) return sum;
    const double most = optimum - base;
    if (!std::isfinite(ceiling)) return sum + most * (temperature - optimum);
    const double width = ceiling - optimum, left = std::max(0.0, ceiling - temperature) / width;
    sum += most * width / 2 * (1 - left * left);
    return sum;
}

double ThermalTime::mean_between(double begin, double end) const {
    if (std::abs(end - begin) < 1e-6) return at((begin + end) / 2);
    return (integral_to(end) - integral_to(begin)) / (end - begin);
}

}  // namespace espalier::environment
