// How far stomata open. Conductances to water vapour in mol m-2 s-1 of one-sided leaf area.
#pragma once

#include <string>

namespace espalier::environment::leaf {

/// What stomata answer to, at the surface of the leaf.
struct AtSurface {
    double assimilation = 0;    ///< A, umol m-2 s-1
    double carbon_dioxide = 0;  ///< Cs, umol mol-1
    double deficit = 1;         ///< D, kPa
    double saturation = 1;      ///< pressure of saturated vapour at the leaf's temperature, kPa
    double compensation = 0;    ///< Gamma*, umol mol-1
};

/// Medlyn et al. (2011): g0 + 1.6 (1 + f g1 / sqrt(D)) A / Cs. Leuning (1995): g0 + f a1 A / ((Cs - Gamma*) (1 + D /
/// D0)). Ball, Woodrow & Berry (1987): g0 + f g1 A h / Cs, h the relative humidity. Where A is not above 0: g0.
struct Stomata {
    enum class Form { medlyn, leuning, ball_berry };

    Form form = Form::medlyn;
    double least = 0;        ///< g0
    double slope = 4;        ///< g1, of Medlyn's form in kPa^0.5; a1 of Leuning's
    double deficit_0 = 1.5;  ///< D0 of Leuning's, kPa
    // By the water potential of the leaf (Tuzet, Perrier & Leuning 2003).
    double sensitivity = 0;  ///< sf, MPa-1; 0: stomata do not know it
    double reference = -2;   ///< psi_f, MPa
    double dry = -5;         ///< psi_dry, MPa: below it `least` falls, too, e-fold in 0.5 MPa

    /// f, from 1 of a wet leaf to 0: (1 + exp(sf psi_f)) / (1 + exp(sf (psi_f - psi))), psi in MPa.
    double by_potential(double potential) const;
    /// The conductance that they answer at a water potential, MPa. The least one falls below `dry`: a leaf that has
    /// dried gives nothing.
    double opening(const AtSurface& surface, double potential = 0) const;
};

/// Deficits below this count as this, kPa: the forms know no saturated air.
inline constexpr double least_deficit = 0.01;

}  // namespace espalier::environment::leaf
