#include "environment/leaf/gas/gas_exchange.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

constexpr int most_steps = 100;
constexpr double closed = 1e-9;  ///< mol m-2 s-1: less than any leaf lets through is nothing
constexpr double reach = 60;     ///< K, of the leaf's temperature from the air's

/// A leaf whose stomata are sought: for each conductance there is one temperature, and one rate of assimilation.
class SoughtLeaf {
public:
    SoughtLeaf(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential)
        : leaf_(leaf),
          light_(light),
          air_(air),
          stomata_(leaf.stomata.at_potential(potential)),
          potential_(potential),
          factor_(leaf.stomata.by_potential(potential)),
          layer_(BoundaryLayer::forced(leaf.width, air.wind)),
          absorbed_(light.short_wave() + leaf.emissivity * light.thermal),
          temperature_(air.temperature) {}

    /// Holds the leaf at a temperature, whatever energy it takes.
    void hold(double temperature) {
        temperature_ = temperature;
        is_held_ = true;
    }

    GasExchange found() {
        const double g = conductance();
        const Limits::Assimilation carbon = open(g);
        GasExchange found;
        found.conductance = g;
        found.temperature = temperature_;
        found.assimilation = carbon.rate;
        found.internal = carbon.ci;
        found.at_surface = at_surface(carbon.rate);
        found.deficit = deficit(g);
        found.transpiration = transpiration(g, saturation_);
        found.sensible = sensible(temperature_);
        found.latent = latent_heat(temperature_) * found.transpiration;
        found.sent = sent(temperature_);
        return found;
    }

    /// After found(): stomata answer g = opening(g, psi), so that dg/dpsi is its slope with psi over 1 less that with
    /// g.
    double transpiration_by_potential(const GasExchange& found) {
        constexpr double share = 1e-5, step = 1e-5;  // of g; MPa
        const double g = found.conductance;
        if (!(g > 0)) return 0;
        const AtSurface at = surface(g, found.assimilation);
        const auto opened = [&](double potential) {
            return leaf_.stomata.at_potential(potential).opening(at, leaf_.stomata.by_potential(potential)).conductance;
        };
        const double by_potential = (opened(potential_ + step) - opened(potential_ - step)) / (2 * step);
        if (!(by_potential > 0)) return 0;
        const double wider = (1 + share) * g;
        const double by_conductance = wish(wider) / (share * g);  // of the wish, which was 0: below 0
        const double lost = transpiration(wider, saturation_) - found.transpiration;
        return by_conductance < 0 ? std::max(0.0, lost / (share * g) * by_potential / -by_conductance) : 0;
    }

private:
    double supply(double g) const { return 1 / (vapour_to_carbon / g + 1 / layer_.carbon_dioxide()); }
    double at_surface(double rate) const { return air_.carbon_dioxide - rate / layer_.carbon_dioxide(); }
    double deficit(double g) const {
        return (saturation_ - air_.vapour_pressure) * layer_.vapour / (g + layer_.vapour);
    }
    double transpiration(double g, double saturation) const {
        return (saturation - air_.vapour_pressure) / air_.pressure * g * layer_.vapour / (g + layer_.vapour);
    }
    double sensible(double temperature) const {
        return 2 * layer_.heat * molar_heat * (temperature - air_.temperature);
    }
    double sent(double temperature) const { return 2 * leaf_.emissivity * black_body(temperature); }

    /// Newton's steps: what the leaf loses rises with its temperature, the faster the warmer it is.
    void find_temperature(double g) {
        for (int step = 0; step < most_steps && !is_held_; ++step) {
            const double t = temperature_, vapour = transpiration(g, saturation_pressure(t));
            const double surplus = absorbed_ - sent(t) - sensible(t) - latent_heat(t) * vapour;
            const double slope =
                4 * sent(t) / (t + kelvin) + 2 * layer_.heat * molar_heat +
                latent_heat(t) * saturation_slope(t) / air_.pressure * g * layer_.vapour / (g + layer_.vapour);
            const double change = surplus / slope;
            temperature_ += change;
            if (!(std::abs(temperature_ - air_.temperature) < reach)) fail();
            if (std::abs(change) < 1e-12) break;
        }
    }

    [[noreturn]] void fail() const {
        throw RunError(
            fmt::format("a leaf that absorbs {:g} W/m2 in air of {:g} degrees finds no temperature within {:g} K "
                        "of it",
                        absorbed_, air_.temperature, reach));
    }

    /// With this conductance. A closed leaf in the light keeps itself at its compensation point; in the dark its
    /// respiration seeps out.
    Limits::Assimilation open(double g) {
        find_temperature(g);
        saturation_ = saturation_pressure(temperature_);
        limits_ = limits_of(leaf_.photosynthesis, light_.photons, temperature_, air_.pressure);
        if (g > 0) return limits_.supplied(air_.carbon_dioxide, supply(g));
        const double rate = limits_.at(air_.carbon_dioxide);
        if (rate > 0) return {0, limits_.compensation_point(), 0};
        return {rate, air_.carbon_dioxide, 0};
    }

    AtSurface surface(double g, double rate) const {
        return {rate, at_surface(rate), deficit(g), saturation_, limits_.compensation};
    }

    /// What stomata answer to this conductance, less it.
    double wish(double g) {
        const double rate = open(g).rate;
        return stomata_.opening(surface(g, rate), factor_).conductance - g;
    }

    /// As far as the air lets it breathe, stomata could not open further than this.
    double upper_bound(double lower) {
        const double rate = open(layer_.carbon_dioxide() * 1e3).rate;
        const double vapour_excess = std::max(saturation_ - air_.vapour_pressure, 0.0);
        double bound = rate > 0 ? stomata_.upper_bound(surface(0, rate), factor_, layer_.vapour, vapour_excess) : 0;
        bound = 2 * std::max(bound, lower);
        for (int step = 0; step < most_steps && wish(bound) > 0; ++step) bound *= 2;
        return bound;
    }

    double conductance() {
        const double lower = std::max(stomata_.least, closed);
        const double at_lower = wish(lower);
        if (at_lower <= 0) return stomata_.least;
        const double upper = upper_bound(lower);
        return root(lower, at_lower, upper, wish(upper));
    }

    /// Between two conductances of opposite wishes, by the rule of Anderson & Bjorck (1973).
    double root(double a, double at_a, double b, double at_b) {
        for (int step = 0; step < most_steps; ++step) {
            const double x = b - at_b * (b - a) / (at_b - at_a);
            const double at_x = wish(x);
            if ((at_x > 0) != (at_b > 0)) {
                a = b;
                at_a = at_b;
            } else {
                const double kept = 1 - at_x / at_b;
                at_a *= kept > 0 ? kept : 0.5;
            }
            const bool is_there = std::abs(at_x) <= 1e-13 * x || std::abs(x - b) <= 1e-15 * x;
            b = x;
            at_b = at_x;
            if (is_there) break;
        }
        return b;
    }

    const LeafKind& leaf_;
    const LeafLight& light_;
    const Air& air_;
    Stomata stomata_;  ///< at the potential
    double potential_, factor_;
    BoundaryLayer layer_;
    double absorbed_;
    bool is_held_ = false;
    // Of the conductance that was looked at last.
    double temperature_, saturation_ = 0;
    Limits limits_;
};

double absorbed(const LeafKind& leaf, const LeafLight& light) {
    return light.short_wave() + leaf.emissivity * light.thermal;
}

double relative(double difference, std::initializer_list<double> terms) {
    double largest = 0;
    for (const double term : terms) largest = std::max(largest, std::abs(term));
    return largest > 0 ? std::abs(difference) / largest : 0;
}

}  // namespace

BoundaryLayer BoundaryLayer::forced(double width, double wind) {
    const double root = 1.4 * std::sqrt(wind / width);
    return {0.135 * root, 0.147 * root};
}

double Residuals::largest() const {
    return std::max({carbon, stomata, vapour, energy});
}

GasExchange gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential) {
    return SoughtLeaf(leaf, light, air, potential).found();
}

SlopingExchange sloping_gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential) {
    SoughtLeaf sought(leaf, light, air, potential);
    const GasExchange found = sought.found();
    return {found, sought.transpiration_by_potential(found)};
}

GasExchange gas_exchange_at(const LeafKind& leaf, const LeafLight& light, const Air& air, double temperature,
                            double potential) {
    SoughtLeaf sought(leaf, light, air, potential);
    sought.hold(temperature);
    return sought.found();
}

Residuals residuals_of(const GasExchange& found, const LeafKind& leaf, const LeafLight& light, const Air& air,
                       double potential) {
    const Limits limits = limits_of(leaf.photosynthesis, light.photons, found.temperature, air.pressure);
    const double saturation = saturation_pressure(found.temperature);
    const AtSurface surface{found.assimilation, found.at_surface, found.deficit, saturation, limits.compensation};
    const double opening =
        leaf.stomata.at_potential(potential).opening(surface, leaf.stomata.by_potential(potential)).conductance;
    const double used = limits.at(found.internal);
    const double respired = leaf.photosynthesis.respiration.at(found.temperature);
    const double supplied = found.conductance / vapour_to_carbon * (found.at_surface - found.internal);
    const double evaporated = found.conductance * found.deficit / air.pressure;
    Residuals residuals;
    residuals.carbon = std::max(
        relative(used - found.assimilation, {used, found.assimilation, respired}),
        found.conductance > 0
            ? relative(supplied - found.assimilation, {found.conductance * found.at_surface / vapour_to_carbon})
            : 0);
    residuals.stomata = relative(opening - found.conductance, {opening, found.conductance});
    residuals.vapour = relative(evaporated - found.transpiration, {evaporated, found.transpiration});
    residuals.energy = relative(absorbed(leaf, light) - found.sent - found.sensible - found.latent,
                                {absorbed(leaf, light), found.sent, found.sensible, found.latent});
    return residuals;
}

}  // namespace espalier::environment::leaf
