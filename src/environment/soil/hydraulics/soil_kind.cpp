#include "environment/soil/hydraulics/soil_kind.h"

#include "espalier/base/math.h"

namespace espalier::environment {
namespace {

/// 1 - (1 - u)^m without cancellation.
double one_minus_power(double u, double m) {
    const double y = m * math::log1p(-u);
    if (y > -0.01) return -y * (1 + y / 2 * (1 + y / 3 * (1 + y / 4 * (1 + y / 5))));
    return 1 - math::exp(y);
}

/// 1 / (1 + (alpha |h|)^n) = Se^(1/m) of van Genuchten.
double inner_saturation(const SoilKind& soil, double head) {
    return 1 / (1 + math::any_power(-soil.alpha * head, soil.n));
}

}  // namespace

double effective_saturation(const SoilKind& soil, double head) {
    if (head >= 0) return 1;
    switch (soil.model) {
        case SoilKind::Model::van_genuchten:
            return math::any_power(inner_saturation(soil, head), 1 - 1 / soil.n);
        case SoilKind::Model::brooks_corey:
            return -soil.alpha * head <= 1 ? 1 : math::any_power(-soil.alpha * head, -soil.n);
        case SoilKind::Model::curves:
            return (soil.curves->content(head) - soil.residual) / (soil.saturated - soil.residual);
        default:
            return math::exp(soil.alpha * head);
    }
}

double conductivity(const SoilKind& soil, double head) {
    if (head >= 0) return soil.conductivity;
    if (soil.model == SoilKind::Model::curves) return soil.curves->conductivity(head);
    const double saturation = effective_saturation(soil, head);
    switch (soil.model) {
        case SoilKind::Model::van_genuchten: {
            const double part = one_minus_power(inner_saturation(soil, head), 1 - 1 / soil.n);
            return soil.conductivity * math::any_power(saturation, soil.l) * part * part;
        }
        case SoilKind::Model::brooks_corey:
            return soil.conductivity * math::any_power(saturation, 3 + 2 / soil.n);
        default:
            return soil.conductivity * saturation;
    }
}

}  // namespace espalier::environment
