// Photosynthesis of leaves: C3 by Farquhar, von Caemmerer & Berry (1980) with the constants of Bernacchi et al. (2001),
// C4 by von Caemmerer (2000, chapter 4). Rates in umol m-2 s-1 of one-sided leaf area, carbon dioxide in umol mol-1.
#pragma once

#include "environment/leaf/gas/air.h"

#include <array>
#include <cstddef>
#include <limits>

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

/// Of one kind of leaf. The defaults are C3.
struct Photosynthesis {
    Pathway pathway = Pathway::c3;
    Response carboxylation{78.5, 65330};                             ///< V, of Rubisco
    Response electron_transport{150, 43540};                         ///< Jmax
    Response respiration{2.12, 46390};                               ///< Rd, in the light
    double phosphate_use = std::numeric_limits<double>::infinity();  ///< TPU
    double quantum_yield = 0.24;                                     ///< mol electrons per mol absorbed photons
    double curvature = 0.85;                                         ///< of the response of electron transport to light
    // C4 alone.
    Response carboxylation_pep{120, 70370};  ///< Vp, of PEP carboxylase
    double regeneration_pep = 80;            ///< Vpr
    double bundle_sheath = 0.003;            ///< conductance, mol m-2 s-1
    double share_of_mesophyll = 0.4;         ///< of electron transport, x

    static Photosynthesis of_c4();
};

/// One of the processes that may limit a leaf: A = rate (Ci - point) / (Ci + half) + slope Ci - loss. It never falls
/// where Ci rises.
struct Limit {
    double rate = 0, point = 0, half = 0, slope = 0, loss = 0;

    double at(double ci) const { return rate * (ci - point) / (ci + half) + slope * ci - loss; }
    double derivative(double ci) const { return rate * (half + point) / ((ci + half) * (ci + half)) + slope; }
    /// Ci where the leaf uses what reaches it from `outside` through a conductance (mol m-2 s-1).
    double supplied(double outside, double conductance) const;
};

/// The limits of a leaf at one temperature in one light.
struct Limits {
    std::array<Limit, 5> limits;
    std::size_t count = 0;
    double compensation = 0;  ///< Gamma*, umol mol-1; 0 of C4

    struct Assimilation {
        double rate = 0, ci = 0;
        double derivative = 0;  ///< by Ci, of the limit that holds
    };
    /// The least of the limits.
    double at(double ci) const;
    /// Ci at which the leaf neither takes nor gives; there is one where the least of the limits is above 0 somewhere.
    double compensation_point() const;
    Assimilation supplied(double outside, double conductance) const;
};

/// `photons` of PAR are absorbed, umol m-2 s-1.
Limits limits_of(const Photosynthesis& leaf, double photons, double temperature, double pressure = sea_level);

/// J, umol electrons m-2 s-1: the smaller root of curvature J^2 - (yield Q + Jmax) J + yield Q Jmax = 0.
double electron_transport(const Photosynthesis& leaf, double photons, double temperature);

}  // namespace espalier::environment::leaf
