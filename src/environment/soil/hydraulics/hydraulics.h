// A soil's curves as a table that is read without a logarithm or a power: content, conductivity, matric flux potential.
#pragma once

#include "environment/soil/hydraulics/soil_kind.h"

#include <vector>

namespace espalier::environment {

/// A soil at one pressure head, in cm and days.
struct SoilPoint {
    double head = 0;
    double content = 0;
    double capacity = 0;      ///< d content / d head
    double conductivity = 0;  ///< d potential / d head
    double slope = 0;         ///< d conductivity / d head
    double potential = 0;     ///< matric flux potential, the integral of the conductivity from dry soil, cm2/d
};

/// What of it flow needs.
struct SoilFlow {
    double conductivity = 0, slope = 0, potential = 0;  ///< as in SoilPoint
};

/// Monotone cubic interpolation between nodes that divide every octave of |head| into 64, from 1e-3 cm to 1e9 cm;
/// straight from there to full soil, so that a clay whose conductivity falls steeply at saturation (n = 1.1) reaches
/// its right value.
class SoilHydraulics {
public:
    explicit SoilHydraulics(const SoilKind& soil);

    const SoilKind& soil() const { return soil_; }
    SoilPoint at(double head) const;
    SoilFlow flow_at(double head) const;
    /// The head at which the soil holds this much; 0 if it is full. Found soon if it is near `guess`.
    double head_at(double content, double guess = -100) const;
    /// The head at which it conducts this well; 0 if as well as full soil. Found soon if it is near `guess`.
    double head_of_conductivity(double conductivity, double guess = -100) const;

private:
    struct Node {
        double suction, saturation, saturation_slope, conductivity, conductivity_slope, potential;
    };
    struct Place;
    Place place_of(double head) const;
    static SoilFlow flow_at(const Place& place);
    SoilPoint nearly_full(double head) const;
    double suction_at(double wanted, double full, double Node::*value, double Node::*slope, double guess) const;
    std::size_t node_before(double wanted, double Node::*value, double guess) const;
    void fill();
    void integrate();
    void limit_slopes();

    SoilKind soil_;
    std::vector<Node> nodes_;  ///< by rising suction, -head
};

}  // namespace espalier::environment
