// What a piece of root takes of a solute.
#pragma once

#include "environment/soil/solutes/sorption.h"

#include <span>

namespace espalier::environment {

/// Active uptake per root surface vmax (c - cmin) / (km + c - cmin), c at the root's surface (Michaelis & Menten 1913;
/// Barber 1995), and `passive`, the part of the solute in the water that a root takes which enters with it.
struct UptakeKinetics {
    double vmax = 0;     ///< amount/cm2/d
    double km = 1;       ///< amount/cm3
    double cmin = 0;     ///< amount/cm3
    double passive = 0;  ///< 0 to 1

    bool any() const { return vmax > 0 || passive > 0; }
};

/// A piece of root and the soil through which the solute comes to it, at a steady rate from all of a hollow cylinder
/// (as zone.h has it for water): at the root's surface it is enrichment c - resistance F for an uptake F and the
/// voxel's concentration c. With water that moves to the root at `water`, 0 or more, the enrichment is exp(x), x =
/// water distance / (theta D), and the resistance (exp(x) - 1) / water.
struct SolutePath {
    double enrichment = 1, resistance = 0;  ///< d/cm
    double water = 0;                       ///< what the root takes, cm/d

    /// `distance`: radius times zone factor, cm; `conductivity`: theta D of the soil, cm2/d.
    static SolutePath of(double water, double distance, double conductivity);
};

struct SoluteFlow {
    double flux = 0;              ///< amount/cm2/d
    double by_concentration = 0;  ///< cm/d
    double surface = 0;           ///< concentration at the root's surface
};

SoluteFlow solute_flow(const UptakeKinetics& kinetics, const SolutePath& path, double concentration);

/// Roots in a voxel: surface per volume of soil, 1/cm.
struct RootSurface {
    SolutePath path;
    double surface = 0;
};

/// What each takes from a voxel during `days`, amount per volume of soil, into `taken`; returns what is left of
/// `amount`. Of second order (SDIRK2, Alexander 1977); implicit Euler where that would take more than there is. Never
/// negative.
double take_up(const UptakeKinetics& kinetics, const Sorption& sorption, double content, double amount,
               std::span<const RootSurface> roots, double days, std::span<double> taken);

}  // namespace espalier::environment
