// The soil around a root, finer than a voxel.
#pragma once

#include "environment/soil/hydraulics/hydraulics.h"

namespace espalier::environment {

/// The hollow cylinder of soil that a piece of root dries (Schroeder et al. 2008): water moves to the root at a steady
/// rate from all of it, so that the matric flux potential falls from the voxel's, at the radius where the content is
/// the mean (0.53 of the outer one; de Jong van Lier et al. 2008), to that at the root's surface by q r f, f = (rho^2
/// ln(0.53 rho) - (0.53^2 rho^2 - 1) / 2) / (rho^2 - 1), rho = outer radius / r.
double zone_factor(double radius, double outer_radius);

/// What enters a root per surface, cm/d, at a pressure head in the xylem, cm; and how it changes.
struct RadialFlow {
    double flux = 0;
    double surface_head = 0;  ///< of the soil at the root's surface, cm
    double by_xylem = 0;      ///< not positive, 1/d
    double by_soil = 0;       ///< with the voxel's head, 1/d
};

/// `radial`: conductivity of the root, 1/d; `resistance`: radius times zone_factor, cm; `guess`: of the head at the
/// surface, where the search begins if it lies between the two others.
RadialFlow radial_flow(const SoilHydraulics& soil, const SoilPoint& voxel, double xylem_head, double radial,
                       double resistance, double guess = 1);

}  // namespace espalier::environment
