// How much water flows between two points of a soil.
#pragma once

#include "environment/soil/hydraulics/hydraulics.h"

namespace espalier::environment {

/// A flux in cm/d and how it changes with the heads at both ends, 1/d.
struct SoilFlux {
    double flux = 0;
    double by_first = 0, by_second = 0;
};

/// Downwards from `upper` to `lower`, `distance` cm below it, in one soil. The flux of steady flow in a soil whose
/// conductivity is exponential between the two heads, as steep as makes its integral the soil's own: with the head
/// difference much smaller than its range this is Darcy's law with the integral mean; where gravity rules, the upper
/// point's conductivity; zero in hydrostatic soil, whatever the distance. (Scharfetter & Gummel 1969 for electrons;
/// Baker 2000 for Richards' equation.)
SoilFlux flux_down(const SoilPoint& upper, const SoilPoint& lower, double distance);

/// Across, in one soil: the difference of the matric flux potentials over the distance.
SoilFlux flux_across(const SoilPoint& first, const SoilPoint& second, double distance);

/// The same from one soil into another, the border half way: the flux is the same in both halves. `down`: with gravity.
SoilFlux flux_between_soils(const SoilHydraulics& first, const SoilPoint& a, const SoilHydraulics& second,
                            const SoilPoint& b, double distance, bool down);

}  // namespace espalier::environment
