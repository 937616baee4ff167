#include "environment/soil/roots/zone.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// Relative. Newton's method squares it: what is left is below 1e-9.
constexpr double small_step = 1e-5;

}  // namespace

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
    SoilFlow at = soil.flow_at(head);
    for (int i = 0; i < 80; ++i) {
        const double excess = both * (head - xylem_head) + at.potential - voxel.potential;
        (excess > 0 ? high : low) = head;
        const double step = -excess / (both + at.conductivity);
        if (std::abs(step) <= small_step * (1 + std::abs(head)) || !(low < high)) {
            head += step;
            at.conductivity += at.slope * step;
            break;
        }
        const double next = head + step;
        head = next >= low && next <= high ? next : 0.5 * (low + high);
        at = soil.flow_at(head);
    }
    const double share = at.conductivity / (both + at.conductivity);
    return {radial * (head - xylem_head), head, -radial * share,
            radial * voxel.conductivity / (both + at.conductivity)};
}

}  // namespace espalier::environment
