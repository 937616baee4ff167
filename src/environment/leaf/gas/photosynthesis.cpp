#include "environment/leaf/gas/photosynthesis.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

constexpr double reference = 298.15;  // K
constexpr double oxygen = 210;        // mmol mol-1
// Bernacchi et al. (2001): at 25 degrees in umol mol-1, mmol mol-1 and umol mol-1.
constexpr Response michaelis_carbon{404.9, 79430}, michaelis_oxygen{278.4, 36380}, compensation_point{42.75, 37830};
// Of PEP carboxylase, with the activation energy of von Caemmerer (2000, table 4.1: Q10 of 2.1).
constexpr Response michaelis_pep{80, 54800};

Limits of_c3(const Photosynthesis& leaf, double electrons, double temperature, double to_sea_level) {
    Limits all;
    const double gamma = compensation_point.at(temperature) * to_sea_level;
    const double half =
        michaelis_carbon.at(temperature) * (1 + oxygen / michaelis_oxygen.at(temperature)) * to_sea_level;
    const double loss = leaf.respiration.at(temperature);
    all.compensation = gamma;
    all.limits[all.count++] = {leaf.carboxylation.at(temperature), gamma, half, 0, loss};
    all.limits[all.count++] = {electrons / 4, gamma, 2 * gamma, 0, loss};
    if (std::isfinite(leaf.phosphate_use)) all.limits[all.count++] = {3 * leaf.phosphate_use, 0, 0, 0, loss};
    return all;
}

// Half of the respiration is the mesophyll's.
Limits of_c4(const Photosynthesis& leaf, double electrons, double temperature, double to_sea_level) {
    Limits all;
    const double loss = leaf.respiration.at(temperature), sheath = leaf.bundle_sheath;
    const double half = michaelis_pep.at(temperature) * to_sea_level;
    const double x = leaf.share_of_mesophyll;
    all.limits[all.count++] = {leaf.carboxylation_pep.at(temperature), 0, half, sheath, loss / 2};
    all.limits[all.count++] = {leaf.regeneration_pep, 0, 0, sheath, loss / 2};
    all.limits[all.count++] = {leaf.carboxylation.at(temperature), 0, 0, 0, loss};
    all.limits[all.count++] = {x * electrons / 2, 0, 0, sheath, loss / 2};
    all.limits[all.count++] = {(1 - x) * electrons / 3, 0, 0, 0, loss};
    return all;
}

}  // namespace

double Response::at(double temperature) const {
    const double t = temperature + kelvin;
    double factor = math::exp(activation * (t - reference) / (reference * gas_constant * t));
    if (deactivation > 0) {
        const auto active = [&](double at) {
            return 1 + math::exp((at * entropy - deactivation) / (at * gas_constant));
        };
        factor *= active(reference) / active(t);
    }
    return at_25 * factor;
}

Photosynthesis Photosynthesis::of_c4() {
    Photosynthesis leaf;
    leaf.pathway = Pathway::c4;
    leaf.carboxylation.at_25 = 60;
    leaf.electron_transport.at_25 = 400;
    leaf.respiration.at_25 = 0.6;
    leaf.quantum_yield = 0.425;  // of two photosystems, 15 % of photons being of no use
    leaf.curvature = 0.7;
    return leaf;
}

double electron_transport(const Photosynthesis& leaf, double photons, double temperature) {
    const double most = leaf.electron_transport.at(temperature), used = leaf.quantum_yield * photons;
    const double sum = used + most;
    const double root = std::sqrt(std::max(0.0, sum * sum - 4 * leaf.curvature * used * most));
    return sum + root > 0 ? 2 * used * most / (sum + root) : 0;
}

double Limit::supplied(double outside, double conductance) const {
    const double square = conductance + slope;
    const double linear = rate + slope * half - loss + conductance * (half - outside);
    const double constant = rate * point + loss * half + conductance * outside * half;
    const double root = std::sqrt(std::max(0.0, linear * linear + 4 * square * constant));
    // The positive root, without cancellation.
    return linear > 0 ? 2 * constant / (linear + root) : (root - linear) / (2 * square);
}

double Limits::at(double ci) const {
    double least = limits[0].at(ci);
    for (std::size_t i = 1; i < count; ++i) least = std::min(least, limits[i].at(ci));
    return least;
}

double Limits::compensation_point() const {
    double point = 0;
    for (std::size_t i = 0; i < count; ++i) point = std::max(point, limits[i].supplied(0, 0));
    return point;
}

Limits::Assimilation Limits::supplied(double outside, double conductance) const {
    Assimilation least;
    for (std::size_t i = 0; i < count; ++i) {
        const double ci = limits[i].supplied(outside, conductance);
        const double rate = conductance * (outside - ci);
        if (i == 0 || rate < least.rate) least = {rate, ci, limits[i].derivative(ci)};
    }
    return least;
}

Limits limits_of(const Photosynthesis& leaf, double photons, double temperature, double pressure) {
    const double electrons = electron_transport(leaf, photons, temperature);
    const double to_sea_level = sea_level / pressure;
    return leaf.pathway == Pathway::c4 ? of_c4(leaf, electrons, temperature, to_sea_level)
                                       : of_c3(leaf, electrons, temperature, to_sea_level);
}

}  // namespace espalier::environment::leaf
