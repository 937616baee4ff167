// Sugar in a tree of internodes: along concentrations, from where it is loaded to where it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::environment::carbon {

/// A piece of axis. Grams of carbon, centimetres, days.
struct SugarNode {
    static constexpr std::uint32_t no_bearer = 0xFFFFFFFF;

    std::uint32_t bearer = no_bearer;  ///< what it stands on, which comes before it
    double conductance = 0;            ///< between both middles, cm3/d
    double volume = 0;                 ///< that holds sugar, cm3; above 0
    double sugar = 0;                  ///< g, at the beginning of the step
    double source = 0;                 ///< g/d, at least 0
    double sink = 0;                   ///< g/d that its sinks take at most
    double upkeep = 0;                 ///< g/d that its maintenance takes at most
};

/// Where sinks and maintenance take half of the most that they can, g cm-3.
struct HalfSaturation {
    double sink = 0.05, upkeep = 0.0025;
};

/// After Allen, Prusinkiewicz & DeJong (2005) and Prusinkiewicz et al. (2007): flow = conductance times the difference
/// of concentrations; what is taken follows Michaelis & Menten, most C / (half + C). One implicit step of time, so that
/// any length of step is stable and no concentration is negative: by Newton's method, which rises to the solution
/// from below because what is taken is concave (Ortega & Rheinboldt 1970, 13.3), and elimination from the tips.
class SugarTransport {
public:
    /// Returns the concentration of each node at the end of `days`, g cm-3. Valid until the next call. Throws RunError
    /// if it does not converge.
    const std::vector<double>& concentrations(const std::vector<SugarNode>& nodes, double days,
                                              const HalfSaturation& half);

private:
    double correct(const std::vector<SugarNode>& nodes, double days, const HalfSaturation& half);

    std::vector<double> concentrations_, diagonal_, rest_;
};

}  // namespace espalier::environment::carbon
