// The equations of a leaf and how they are solved, for one leaf (T = double) or for several side by side: see lanes.h.
// A lane whose search has ended keeps what it has found, so that it does not matter who stands beside it.
#pragma once

#include "environment/leaf/gas/gas_exchange.h"
#include "environment/leaf/gas/lanes.h"

namespace espalier::environment::leaf {

/// What leaves of one kind may differ in.
template <class T>
struct LeafInputs {
    T photons, near_infrared, thermal;                               ///< see LeafLight
    T potential;                                                     ///< MPa
    T carboxylation, electron_transport, respiration, slope, width;  ///< in place of those of the kind
};

/// What is found, see GasExchange and Residuals.
template <class T>
struct LeafResults {
    T assimilation, transpiration, conductance, temperature, internal, at_surface, deficit;
    T sensible, latent, sent;
    Truth<T> is_lost;  ///< no temperature balances the energy within 60 K of the air
};

template <class T>
ESPALIER_INLINE T saturation_of(T temperature) {
    return 0.6108 * power_of_e<T>(17.27 * temperature / (temperature + 237.3));
}

template <class T>
ESPALIER_INLINE T latent_heat_of(T temperature) {
    return (2.501e6 - 2370 * temperature) * water_molar_mass;
}

// ---- photosynthesis

/// The temperature as the responses know it: (T - 298.15) / (298.15 R T).
template <class T>
struct Warmth {
    T of_activation, kelvins;

    ESPALIER_INLINE explicit Warmth(T temperature)
        : of_activation((temperature + kelvin - reference) / (reference * gas_constant * (temperature + kelvin))),
          kelvins(temperature + kelvin) {}

    ESPALIER_INLINE T factor(const Response& response) const {
        const T rising = power_of_e<T>(response.activation * of_activation);
        if (!(response.deactivation > 0)) return rising;
        const auto active = [&](T at) {
            return 1 + power_of_e<T>((at * response.entropy - response.deactivation) / (at * gas_constant));
        };
        return rising * active(all_of<T>(reference)) / active(kelvins);
    }
    ESPALIER_INLINE T of(const Response& response) const { return response.at_25 * factor(response); }

    static constexpr double reference = 298.15;  // K
};

template <class T>
ESPALIER_INLINE T electrons_of(const Photosynthesis& leaf, T most, T photons) {
    const T used = leaf.quantum_yield * photons, sum = used + most;
    const T root = root_of<T>(larger<T>(sum * sum - 4 * leaf.curvature * used * most, T{}));
    return choose<T>(sum + root > 0, 2 * used * most / (sum + root), T{});
}

template <class T>
ESPALIER_INLINE LimitsOf<T> c3_limits(const Photosynthesis& leaf, const LeafInputs<T>& in, const Warmth<T>& warmth,
                                      double to_sea_level) {
    LimitsOf<T> all;
    const T gamma = warmth.of(compensation_point) * to_sea_level;
    const T inhibited = 1 + oxygen / michaelis_oxygen.at_25 / warmth.factor(michaelis_oxygen);
    const T half = warmth.of(michaelis_carbon) * inhibited * to_sea_level,
            loss = in.respiration * warmth.factor(leaf.respiration);
    const T electrons =
        electrons_of<T>(leaf, in.electron_transport * warmth.factor(leaf.electron_transport), in.photons);
    all.compensation = gamma;
    all.respiration = loss;
    all.limits[all.count++] = {in.carboxylation * warmth.factor(leaf.carboxylation), gamma, half, T{}, loss};
    all.limits[all.count++] = {electrons / 4, gamma, 2 * gamma, T{}, loss};
    if (leaf.phosphate_use < unlimited) {
        all.limits[all.count++] = {all_of<T>(3 * leaf.phosphate_use), T{}, T{}, T{}, loss};
    }
    return all;
}

// Half of the respiration is the mesophyll's.
template <class T>
ESPALIER_INLINE LimitsOf<T> c4_limits(const Photosynthesis& leaf, const LeafInputs<T>& in, const Warmth<T>& warmth,
                                      double to_sea_level) {
    LimitsOf<T> all;
    const T loss = in.respiration * warmth.factor(leaf.respiration), sheath = all_of<T>(leaf.bundle_sheath);
    const T electrons =
        electrons_of<T>(leaf, in.electron_transport * warmth.factor(leaf.electron_transport), in.photons);
    const T half = warmth.of(michaelis_pep) * to_sea_level;
    const double x = leaf.share_of_mesophyll;
    all.compensation = T{};
    all.respiration = loss;
    all.limits[all.count++] = {warmth.of(leaf.carboxylation_pep), T{}, half, sheath, loss / 2};
    all.limits[all.count++] = {all_of<T>(leaf.regeneration_pep), T{}, T{}, sheath, loss / 2};
    all.limits[all.count++] = {in.carboxylation * warmth.factor(leaf.carboxylation), T{}, T{}, T{}, loss};
    all.limits[all.count++] = {x * electrons / 2, T{}, T{}, sheath, loss / 2};
    all.limits[all.count++] = {(1 - x) * electrons / 3, T{}, T{}, T{}, loss};
    return all;
}

template <class T>
ESPALIER_INLINE LimitsOf<T> leaf_limits(const Photosynthesis& leaf, const LeafInputs<T>& in, T temperature,
                                        double pressure) {
    const Warmth<T> warmth(temperature);
    return leaf.pathway == Pathway::c4 ? c4_limits<T>(leaf, in, warmth, sea_level / pressure)
                                       : c3_limits<T>(leaf, in, warmth, sea_level / pressure);
}

/// Ci where the leaf uses what reaches it from `outside` through a conductance (mol m-2 s-1).
template <class T>
ESPALIER_INLINE T supplied_to(const LimitOf<T>& of, T outside, T conductance) {
    const T square = conductance + of.slope;
    const T linear = of.rate + of.slope * of.half - of.loss + conductance * (of.half - outside);
    const T constant = of.rate * of.point + of.loss * of.half + conductance * outside * of.half;
    const T root = root_of<T>(larger<T>(linear * linear + 4 * square * constant, T{}));
    // The positive root, without cancellation.
    const Truth<T> rises = linear > 0;
    return choose<T>(rises, 2 * constant, root - linear) / choose<T>(rises, linear + root, 2 * square);
}

template <class T>
ESPALIER_INLINE T compensation_of(const LimitsOf<T>& all) {
    T point{};
    for (std::size_t i = 0; i < all.count; ++i) point = larger<T>(point, supplied_to<T>(all.limits[i], T{}, T{}));
    return point;
}

template <class T>
struct Assimilated {
    T rate, ci;
};

template <class T>
ESPALIER_INLINE Assimilated<T> assimilated(const LimitsOf<T>& all, T outside, T conductance) {
    Assimilated<T> least{};
    for (std::size_t i = 0; i < all.count; ++i) {
        const T ci = supplied_to<T>(all.limits[i], outside, conductance), rate = conductance * (outside - ci);
        if (i == 0) {
            least = {rate, ci};
            continue;
        }
        const Truth<T> less = rate < least.rate;
        least = {choose<T>(less, rate, least.rate), choose<T>(less, ci, least.ci)};
    }
    return least;
}

// ---- stomata

/// What stomata answer to, see AtSurface.
template <class T>
struct SurfaceOf {
    T assimilation, carbon_dioxide, deficit, saturation, compensation;
};

/// Stomata at a water potential.
template <class T>
struct OpenedStomata {
    const Stomata& kind;
    T least, slope, factor;

    ESPALIER_INLINE OpenedStomata(const Stomata& of, T with_slope, T potential)
        : kind(of), least(all_of<T>(of.least)), slope(with_slope), factor(all_of<T>(1)) {
        const Truth<T> has_dried = potential < of.dry;
        if (is_any(has_dried)) {
            constexpr double width = 0.5;  // MPa
            least = choose<T>(has_dried, of.least * power_of_e<T>((potential - of.dry) / width), least);
        }
        if (of.sensitivity == 0) return;
        const T wet = 1 + power_of_e<T>(all_of<T>(of.sensitivity * of.reference));
        factor = wet / (1 + power_of_e<T>(of.sensitivity * (of.reference - potential)));
    }

    ESPALIER_INLINE T at(const SurfaceOf<T>& surface) const {
        const T deficit = larger<T>(surface.deficit, all_of<T>(least_deficit)), opened = factor * slope;
        T above;
        if (kind.form == Stomata::Form::medlyn) {
            above = vapour_to_carbon * (1 + opened / root_of<T>(deficit)) * surface.assimilation;
            above /= surface.carbon_dioxide;
        } else if (kind.form == Stomata::Form::leuning) {
            above = opened * surface.assimilation /
                    ((surface.carbon_dioxide - surface.compensation) * (1 + deficit / kind.deficit_0));
        } else {
            const T humidity = larger<T>(1 - deficit / surface.saturation, T{});
            above = opened * surface.assimilation * humidity / surface.carbon_dioxide;
        }
        return choose<T>(surface.assimilation > 0, least + above, least);
    }

    /// Not below the conductance at any surface of this leaf, whose A is at most this: where a search begins. `vapour`
    /// is the conductance of the boundary layer, `excess` the vapour pressure in the leaf above that of the air.
    ESPALIER_INLINE T upper_bound(const SurfaceOf<T>& surface, T vapour, T excess) const {
        const T ratio = surface.assimilation / surface.carbon_dioxide, opened = factor * slope;
        if (kind.form == Stomata::Form::leuning) {
            return least + opened * surface.assimilation / (surface.carbon_dioxide - surface.compensation);
        }
        if (kind.form == Stomata::Form::ball_berry) return least + opened * ratio;
        // D = excess vapour / (g + vapour), so that g = g0 + c + m sqrt(g + vapour) is a quadratic in the root.
        const T dryness = larger<T>(excess * vapour, all_of<T>(1e-12));
        const T constant = least + vapour_to_carbon * ratio;
        const T m = vapour_to_carbon * opened * ratio / root_of<T>(dryness);
        const T root = (m + root_of<T>(m * m + 4 * (vapour + constant))) / 2;
        const T damp = constant + vapour_to_carbon * opened * ratio / root_of<T>(all_of<T>(least_deficit));
        return smaller<T>(root * root - vapour, damp);
    }
};

// ---- the leaf

/// A leaf whose stomata are sought: for each conductance there is one temperature, and one rate of assimilation.
template <class T>
class SoughtLeaf {
public:
    ESPALIER_INLINE SoughtLeaf(const LeafKind& leaf, const Air& air, const LeafInputs<T>& in)
        : leaf_(leaf), air_(air), in_(in), stomata_(leaf.stomata, in.slope, in.potential) {
        const T root = root_of<T>(air.wind / in.width);
        heat_ = 2 * molar_heat * BoundaryLayer::of_heat * root;
        vapour_ = BoundaryLayer::of_vapour * root;
        carbon_ = vapour_ / BoundaryLayer::vapour_to_carbon;
        absorbed_ = in.photons / photons_of_joule + in.near_infrared + leaf.emissivity * in.thermal;
        temperature_ = all_of<T>(air.temperature);
        is_lost_ = T{} < T{};
    }

    /// Holds the leaf at a temperature, whatever energy it takes.
    void hold(T temperature) {
        temperature_ = temperature;
        is_held_ = true;
    }

    ESPALIER_INLINE LeafResults<T> found() {
        const T g = conductance();
        const Assimilated<T> carbon = open(g, everyone());
        LeafResults<T> found;
        found.conductance = g;
        found.temperature = temperature_;
        found.assimilation = carbon.rate;
        found.internal = carbon.ci;
        found.at_surface = at_surface(carbon.rate);
        found.deficit = deficit(g);
        found.transpiration = (saturation_ - air_.vapour_pressure) * passing(g);
        found.sensible = heat_ * (temperature_ - air_.temperature);
        found.latent = latent_heat_of<T>(temperature_) * found.transpiration;
        found.sent = sent(temperature_);
        found.is_lost = is_lost_;
        return found;
    }

    /// After found(): stomata answer g = opening(g, psi), so that dg/dpsi is its slope with psi over 1 less that with
    /// g.
    ESPALIER_INLINE T transpiration_by_potential(const LeafResults<T>& found) {
        constexpr double share = 1e-5, step = 1e-5;  // of g; MPa
        const T g = found.conductance;
        const SurfaceOf<T> at = surface(g, found.assimilation);
        const auto opened = [&](T potential) { return OpenedStomata<T>(leaf_.stomata, in_.slope, potential).at(at); };
        const T by_potential = (opened(in_.potential + step) - opened(in_.potential - step)) / (2 * step);
        const T wider = (1 + share) * g;
        const T by_conductance = wish(wider, everyone()) / (share * g);  // of the wish, which was 0: below 0
        const T lost = (saturation_ - air_.vapour_pressure) * passing(wider) - found.transpiration;
        const T slope = larger<T>(lost / (share * g) * by_potential / -by_conductance, T{});
        return choose<T>(both(g > 0, both(by_potential > 0, by_conductance < 0)), slope, T{});
    }

private:
    ESPALIER_INLINE Truth<T> everyone() const { return T{} == T{}; }

    /// Through stomata and boundary layer, per kPa.
    ESPALIER_INLINE T passing(T g) const { return g * vapour_ / ((g + vapour_) * air_.pressure); }
    ESPALIER_INLINE T at_surface(T rate) const { return air_.carbon_dioxide - rate / carbon_; }
    ESPALIER_INLINE T deficit(T g) const { return (saturation_ - air_.vapour_pressure) * vapour_ / (g + vapour_); }
    ESPALIER_INLINE T sent(T temperature) const {
        const T kelvins = temperature + kelvin, square = kelvins * kelvins;
        return 2 * leaf_.emissivity * stefan_boltzmann * (square * square);
    }

    /// Newton's steps: what the leaf loses rises with its temperature, the faster the warmer it is. The error falls
    /// with the square of the last step.
    ESPALIER_INLINE void find_temperature(T g, Truth<T> active) {
        constexpr double small_step = 1e-7;  // K
        if (is_held_) return;
        const T passed = passing(g);
        Truth<T> seeking = both(active, opposite(is_lost_));
        for (int step = 0; step < most_steps && is_any(seeking); ++step) {
            const T t = temperature_, over = 1 / (t + 237.3), saturation = 0.6108 * power_of_e<T>(17.27 * t * over);
            const T heat = latent_heat_of<T>(t) * passed, kelvins = t + kelvin;
            const T cube = 2 * leaf_.emissivity * stefan_boltzmann * (kelvins * kelvins * kelvins);
            const T surplus = absorbed_ - cube * kelvins - heat_ * (t - air_.temperature) -
                              heat * (saturation - air_.vapour_pressure);
            const T change = surplus / (4 * cube + heat_ + heat * (4098 * saturation * over * over));
            temperature_ = choose<T>(seeking, t + change, t);
            is_lost_ =
                either(is_lost_, both(seeking, opposite(math::magnitude(temperature_ - air_.temperature) < reach)));
            seeking = both(both(seeking, opposite(is_lost_)), opposite(math::magnitude(change) < small_step));
        }
    }

    /// With this conductance. A closed leaf in the light keeps itself at its compensation point; in the dark its
    /// respiration seeps out.
    ESPALIER_INLINE Assimilated<T> open(T g, Truth<T> active) {
        find_temperature(g, active);
        saturation_ = saturation_of<T>(temperature_);
        limits_ = leaf_limits<T>(leaf_.photosynthesis, in_, temperature_, air_.pressure);
        const T outside = all_of<T>(air_.carbon_dioxide);
        const Assimilated<T> opened = assimilated<T>(limits_, outside, g * carbon_ / (vapour_to_carbon * carbon_ + g));
        const Truth<T> is_open = g > 0;
        if (!is_any(opposite(is_open))) return opened;
        const T rate = limits_.at(outside);
        const Truth<T> gains = rate > 0;
        return {choose<T>(is_open, opened.rate, choose<T>(gains, T{}, rate)),
                choose<T>(is_open, opened.ci, choose<T>(gains, compensation_of<T>(limits_), outside))};
    }

    ESPALIER_INLINE SurfaceOf<T> surface(T g, T rate) const {
        return {rate, at_surface(rate), deficit(g), saturation_, limits_.compensation};
    }

    /// What stomata answer to this conductance, less it.
    ESPALIER_INLINE T wish(T g, Truth<T> active) {
        const Assimilated<T> carbon = open(g, active);
        return stomata_.at(surface(g, carbon.rate)) - g;
    }

    struct Wished {
        T at, wish;
    };

    /// As far as the air lets it breathe, stomata could not open further than this.
    ESPALIER_INLINE Wished upper_bound(T lower, Truth<T> active) {
        const T rate = open(carbon_ * 1e3, active).rate;
        const T excess = larger<T>(saturation_ - air_.vapour_pressure, T{});
        const T bound = choose<T>(rate > 0, stomata_.upper_bound(surface(T{}, rate), vapour_, excess), T{});
        Wished upper{2 * larger<T>(bound, lower), T{}};
        Truth<T> seeking = active;
        for (int step = 0; step < most_steps; ++step) {
            upper.wish = choose<T>(seeking, wish(upper.at, seeking), upper.wish);
            seeking = both(seeking, upper.wish > 0);
            if (!is_any(seeking)) break;
            upper.at = choose<T>(seeking, 2 * upper.at, upper.at);
        }
        return upper;
    }

    ESPALIER_INLINE T conductance() {
        const T lower = larger<T>(stomata_.least, all_of<T>(closed));
        const T at_lower = wish(lower, everyone());
        const Truth<T> opens = at_lower > 0;
        if (!is_any(opens)) return stomata_.least;
        const Wished upper = upper_bound(lower, opens);
        return choose<T>(opens, root({lower, at_lower}, upper, opens), stomata_.least);
    }

    /// Between two conductances of opposite wishes, by the rule of Anderson & Bjorck (1973).
    ESPALIER_INLINE T root(Wished a, Wished b, Truth<T> seeking) {
        for (int step = 0; step < most_steps && is_any(seeking); ++step) {
            const T x = b.at - b.wish * (b.at - a.at) / (b.wish - a.wish), at_x = wish(x, seeking);
            const T kept = 1 - at_x / b.wish;
            const Truth<T> crosses = opposite((at_x > 0) == (b.wish > 0)), moves = both(seeking, crosses);
            const T shrunk = a.wish * choose<T>(kept > 0, kept, all_of<T>(0.5));
            a.wish = choose<T>(seeking, choose<T>(crosses, b.wish, shrunk), a.wish);
            a.at = choose<T>(moves, b.at, a.at);
            const Truth<T> is_there =
                either(math::magnitude(at_x) <= 1e-13 * x, math::magnitude(x - b.at) <= 1e-15 * x);
            b.at = choose<T>(seeking, x, b.at);
            b.wish = choose<T>(seeking, at_x, b.wish);
            seeking = both(seeking, opposite(is_there));
        }
        return b.at;
    }

    static constexpr int most_steps = 100;
    static constexpr double closed = 1e-9;  ///< mol m-2 s-1: less than any leaf lets through is nothing
    static constexpr double reach = 60;     ///< K, of the leaf's temperature from the air's

    const LeafKind& leaf_;
    const Air& air_;
    const LeafInputs<T>& in_;
    OpenedStomata<T> stomata_;  ///< at the potential
    T heat_, vapour_, carbon_;  ///< of the boundary layer: both sides for heat, W m-2 K-1
    T absorbed_;
    bool is_held_ = false;
    // Of the conductance that was looked at last.
    T temperature_, saturation_;
    Truth<T> is_lost_;
    LimitsOf<T> limits_;
};

template <class T>
ESPALIER_INLINE T relative_to(T difference, T first, T second, T third = T{}, T fourth = T{}) {
    const T largest = larger<T>(larger<T>(math::magnitude(first), math::magnitude(second)),
                                larger<T>(math::magnitude(third), math::magnitude(fourth)));
    return choose<T>(largest > 0, math::magnitude(difference) / largest, T{});
}

template <class T>
struct ResidualsOf {
    T carbon, stomata, vapour, energy;

    ESPALIER_INLINE T largest() const { return larger<T>(larger<T>(carbon, stomata), larger<T>(vapour, energy)); }
};

template <class T>
ESPALIER_INLINE ResidualsOf<T> leaf_residuals(const LeafKind& leaf, const Air& air, const LeafInputs<T>& in,
                                              const LeafResults<T>& found) {
    const LimitsOf<T> limits = leaf_limits<T>(leaf.photosynthesis, in, found.temperature, air.pressure);
    const T saturation = saturation_of<T>(found.temperature);
    const SurfaceOf<T> surface{found.assimilation, found.at_surface, found.deficit, saturation, limits.compensation};
    const T opening = OpenedStomata<T>(leaf.stomata, in.slope, in.potential).at(surface);
    const T used = limits.at(found.internal), respired = limits.respiration;
    const T supplied = found.conductance / vapour_to_carbon * (found.at_surface - found.internal);
    const T scale = found.conductance * found.at_surface / vapour_to_carbon;
    const T evaporated = found.conductance * found.deficit / air.pressure;
    const T absorbed = in.photons / photons_of_joule + in.near_infrared + leaf.emissivity * in.thermal;
    ResidualsOf<T> residuals;
    const T brought = choose<T>(found.conductance > 0, relative_to<T>(supplied - found.assimilation, scale, T{}), T{});
    residuals.carbon =
        larger<T>(relative_to<T>(used - found.assimilation, used, found.assimilation, respired), brought);
    residuals.stomata = relative_to<T>(opening - found.conductance, opening, found.conductance);
    residuals.vapour = relative_to<T>(evaporated - found.transpiration, evaporated, found.transpiration);
    residuals.energy = relative_to<T>(absorbed - found.sent - found.sensible - found.latent, absorbed, found.sent,
                                      found.sensible, found.latent);
    return residuals;
}

}  // namespace espalier::environment::leaf
