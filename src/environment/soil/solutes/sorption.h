// How a solute divides itself between the soil's water and its solids.
#pragma once

namespace espalier::environment {

/// Amount per volume of soil: theta c + density s, where s = coefficient c^exponent (Freundlich 1909; linear if the
/// exponent is 1). Concentrations per cm3 of water, densities in g/cm3.
struct Sorption {
    double coefficient = 0, exponent = 1, density = 1.4;

    double amount(double content, double concentration) const;
    /// d amount / d concentration; of dilute water with an exponent below 1 it has no bound.
    double capacity(double content, double concentration) const;
    /// The least of it, for all concentrations.
    double least_capacity(double content) const;
    /// What is left in the water of an amount that is not negative, to 1e-14 of it.
    double concentration(double content, double amount) const;
};

}  // namespace espalier::environment
