#include "environment/soil/roots/zone.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {

double zone_factor(double radius, double outer_radius) {
    constexpr double mean = 0.53;
    const double rho = outer_radius / radius;
    if (!(mean * rho > 1)) return 0;
    const double rho2 = rho * rho;
    return (rho2 * math::log(mean * rho) - 0.5 * (mean * mean * rho2 - 1)) / (rho2 - 1);
}

RadialFlow radial_flow(const SoilHydraulics& soil, const SoilPoint& voxel, double xylem_head, double radial,
                       double resistance, double guess) {
    if (!(radial > 0)) return {0, voxel.head, 0, 0};
    if (!(resistance > 0)) return {radial * (voxel.head - xylem_head), voxel.head, -radial, radial};
    // radial (h - xylem) resistance = potential(voxel) - potential(h), whose two sides cross between the two heads.
    const double both = radial * resistance;
    double low = std::min(xylem_head, voxel.head), high = std::max(xylem_head, voxel.head);
    double head = guess > low && guess < high ? guess : voxel.head;
    SoilPoint at = head == voxel.head ? voxel : soil.at(head);
    for (int i = 0; i < 80; ++i) {
        const double excess = both * (head - xylem_head) + at.potential - voxel.potential;
        (excess > 0 ? high : low) = head;
        const double next = head - excess / (both + at.conductivity);
        // The step after one so small would change no digit that counts.
        const bool done = std::abs(next - head) <= 1e-7 * (1 + std::abs(head)) || !(low < high);
        head = done || (next >= low && next <= high) ? next : 0.5 * (low + high);
        at = soil.at(head);
        if (done) break;
    }
    const double share = at.conductivity / (both + at.conductivity);
    return {radial * (head - xylem_head), head, -radial * share,
            radial * voxel.conductivity / (both + at.conductivity)};
}

}  // namespace espalier::environment
