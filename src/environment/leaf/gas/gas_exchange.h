// A leaf at one moment: photosynthesis, stomata, boundary layer and energy at once.
#pragma once

#include "environment/leaf/gas/air.h"
#include "environment/leaf/gas/photosynthesis.h"
#include "environment/leaf/gas/stomata.h"

namespace espalier::environment::leaf {

/// Conductances of the air at a leaf of this width (m) in this wind, mol m-2 s-1: forced convection (Campbell & Norman
/// 1998, table 7.6).
struct BoundaryLayer {
    double heat = 0;    ///< of one side
    double vapour = 0;  ///< of the side with stomata

    static constexpr double of_heat = 1.4 * 0.135, of_vapour = 1.4 * 0.147;  ///< times the root of wind over width
    static constexpr double vapour_to_carbon = 1.37;
    static BoundaryLayer forced(double width, double wind);
};

/// Of daylight's PAR, umol (McCree 1972).
inline constexpr double photons_of_joule = 4.57;

/// What falls on a leaf and stays there, per area of one side.
struct LeafLight {
    double photons = 0;        ///< of PAR, umol m-2 s-1
    double near_infrared = 0;  ///< W m-2
    double thermal = 0;        ///< radiation of sky, soil and neighbours that meets both sides together, W m-2

    /// W m-2
    double short_wave() const { return photons / photons_of_joule + near_infrared; }
};

struct LeafKind {
    Photosynthesis photosynthesis;
    Stomata stomata;
    double width = 0.05;  ///< m
    double emissivity = 0.97;
};

struct GasExchange {
    double assimilation = 0;   ///< A, net of CO2, umol m-2 s-1
    double transpiration = 0;  ///< E, mol m-2 s-1
    double conductance = 0;    ///< gs, of stomata to vapour, mol m-2 s-1
    double temperature = 0;    ///< of the leaf
    double internal = 0;       ///< Ci, umol mol-1
    double at_surface = 0;     ///< Cs
    double deficit = 0;        ///< D at the surface, kPa
    double sensible = 0;       ///< heat to the air, W m-2
    double latent = 0;         ///< W m-2
    double sent = 0;           ///< thermal radiation of both sides, W m-2
};

/// How far the equations are from holding, each divided by its largest term.
struct Residuals {
    double carbon = 0, stomata = 0, vapour = 0, energy = 0;
    double largest() const;
};

/// Solves the four equations for a leaf whose water potential is `potential` (MPa). Dew is not modelled: stomata alone
/// let vapour through. Throws RunError where it finds no temperature within 60 K of the air's.
GasExchange gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential = 0);
/// The same, and how transpiration changes with the potential, mol m-2 s-1 MPa-1.
struct SlopingExchange {
    GasExchange leaf;
    double transpiration_by_potential = 0;
};
SlopingExchange sloping_gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential);
/// The same where the temperature of the leaf is known, as in a chamber; the energy is that which it would need.
GasExchange gas_exchange_at(const LeafKind& leaf, const LeafLight& light, const Air& air, double temperature,
                            double potential = 0);
Residuals residuals_of(const GasExchange& found, const LeafKind& leaf, const LeafLight& light, const Air& air,
                       double potential = 0);

}  // namespace espalier::environment::leaf
