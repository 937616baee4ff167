#include "espalier/base/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace espalier {

std::uint64_t mix(std::uint64_t value) {
    value += 0x9E3779B97F4A7C15u;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return value ^ (value >> 31);
}

std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
    return mix(mix(a) ^ (b + 0x632BE59BD9B4E019u));
}

RandomKey::RandomKey(std::uint64_t seed, std::uint32_t plant, Stream stream, std::uint64_t salt)
    : value_(mix(mix(mix(seed, plant), static_cast<std::uint64_t>(stream)), salt)) {}

double RandomDraws::uniform() {
    const r123::Philox4x32::ctr_type counter = {
        {static_cast<std::uint32_t>(drawer_), static_cast<std::uint32_t>(drawer_ >> 32), step_, draw_++}};
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(key_.value()), static_cast<std::uint32_t>(key_.value() >> 32)}};
    const auto bits = r123::Philox4x32()(counter, key);
    const std::uint64_t word = (static_cast<std::uint64_t>(bits[1]) << 32) | bits[0];
    return static_cast<double>(word >> 11) * 0x1p-53;
}

double RandomDraws::normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
}

// Marsaglia & Tsang (2000), "A simple method for generating gamma variables". Small shapes give numbers that only
// their logarithms can hold.
double RandomDraws::log_gamma(double shape) {
    if (shape < 1) {
        const double boost = std::log(1 - uniform()) / shape;
        return log_gamma(shape + 1) + boost;
    }
    const double d = shape - 1.0 / 3;
    const double c = 1 / std::sqrt(9 * d);
    while (true) {
        const double x = normal();
        const double v = std::pow(1 + c * x, 3);
        if (v <= 0) continue;
        if (std::log(1 - uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) return std::log(d) + std::log(v);
    }
}

double RandomDraws::beta(double a, double b) {
    const double x = log_gamma(a);
    const double y = log_gamma(b);
    return 1 / (1 + std::exp(y - x));
}

double RandomDraws::binomial(double n, double p) {
    double successes = 0;
    for (double toss = 0; toss < n; ++toss) successes += uniform() < p ? 1 : 0;
    return successes;
}

}  // namespace espalier
