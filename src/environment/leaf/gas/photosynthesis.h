// Photosynthesis of leaves: C3 by Farquhar, von Caemmerer & Berry (1980) with the constants of Bernacchi et al. (2001),
// C4 by von Caemmerer (2000, chapter 4). Rates in umol m-2 s-1 of one-sided leaf area, carbon dioxide in umol mol-1.
#pragma once

#include "environment/leaf/gas/air.h"
#include "environment/leaf/gas/lanes.h"

#include <cstddef>

namespace espalier::environment::leaf {

/// How a rate or a constant changes with temperature: k25 exp(Ha (T - 298.15) / (298.15 R T)), and with a deactivation
/// energy the peaked form of Medlyn et al. (2002).
struct Response {
    double at_25 = 0;
    double activation = 0;    ///< Ha, J mol-1
    double deactivation = 0;  ///< Hd, J mol-1; 0: no peak
    double entropy = 0;       ///< J mol-1 K-1

    double at(double temperature) const;
};

enum class Pathway { c3, c4 };

inline constexpr double unlimited = __builtin_inf();

/// Of one kind of leaf. The defaults are C3.
struct Photosynthesis {
    Pathway pathway = Pathway::c3;
    Response carboxylation{78.5, 65330};      ///< V, of Rubisco
    Response electron_transport{150, 43540};  ///< Jmax
    Response respiration{2.12, 46390};        ///< Rd, in the light
    double phosphate_use = unlimited;         ///< TPU
    double quantum_yield = 0.24;              ///< mol electrons per mol absorbed photons
    double curvature = 0.85;                  ///< of the response of electron transport to light
    // C4 alone.
    Response carboxylation_pep{120, 70370};  ///< Vp, of PEP carboxylase
    double regeneration_pep = 80;            ///< Vpr
    double bundle_sheath = 0.003;            ///< conductance, mol m-2 s-1
    double share_of_mesophyll = 0.4;         ///< of electron transport, x

    static Photosynthesis of_c4();
};

inline constexpr double oxygen = 210;  ///< mmol mol-1
// Bernacchi et al. (2001): at 25 degrees in umol mol-1, mmol mol-1 and umol mol-1.
inline constexpr Response michaelis_carbon{404.9, 79430}, michaelis_oxygen{278.4, 36380};
inline constexpr Response compensation_point{42.75, 37830};
// Of PEP carboxylase, with the activation energy of von Caemmerer (2000, table 4.1: Q10 of 2.1).
inline constexpr Response michaelis_pep{80, 54800};

/// One of the processes that may limit a leaf: A = rate (Ci - point) / (Ci + half) + slope Ci - loss. It never falls
/// where Ci rises. T is a double, or several side by side: see lanes.h.
template <class T>
struct LimitOf {
    T rate{}, point{}, half{}, slope{}, loss{};

    ESPALIER_INLINE T at(T ci) const { return rate * (ci - point) / (ci + half) + slope * ci - loss; }
};

/// The limits of a leaf at one temperature in one light.
template <class T>
struct LimitsOf {
    LimitOf<T> limits[5];
    std::size_t count = 0;
    T compensation{};  ///< Gamma*, umol mol-1; 0 of C4
    T respiration{};

    /// The least of the limits.
    ESPALIER_INLINE T at(T ci) const {
        T least = limits[0].at(ci);
        for (std::size_t i = 1; i < count; ++i) least = smaller<T>(least, limits[i].at(ci));
        return least;
    }
};
using Limit = LimitOf<double>;
using Limits = LimitsOf<double>;

/// `photons` of PAR are absorbed, umol m-2 s-1.
Limits limits_of(const Photosynthesis& leaf, double photons, double temperature, double pressure = sea_level);

/// J, umol electrons m-2 s-1: the smaller root of curvature J^2 - (yield Q + Jmax) J + yield Q Jmax = 0.
double electron_transport(const Photosynthesis& leaf, double photons, double temperature);

}  // namespace espalier::environment::leaf
