// Warmth that plants count.
#pragma once

#include <limits>

namespace espalier::environment {

/// Degrees that count at a temperature: none below the base, rising to optimum - base, then falling to none at the
/// ceiling; without a ceiling they stay (Wang & Engel 1998 name the three cardinal temperatures).
struct ThermalTime {
    double base = 0, optimum = std::numeric_limits<double>::infinity();
    double ceiling = std::numeric_limits<double>::infinity();

    double at(double temperature) const;
    /// The mean while the temperature changes evenly from one to another, exactly.
    double mean_between(double begin, double end) const;

private:
    double integral_to(double temperature) const;
};

}  // namespace espalier::environment
