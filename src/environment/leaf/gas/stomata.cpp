#include "environment/leaf/gas/stomata.h"

#include "espalier/base/math.h"

#include "environment/leaf/gas/air.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

Opening medlyn(const Stomata& stomata, const AtSurface& at, double factor) {
    const double opened = factor * stomata.slope / std::sqrt(at.deficit);
    const double by_assimilation = vapour_to_carbon * (1 + opened) / at.carbon_dioxide;
    const double above = by_assimilation * at.assimilation;
    return {stomata.least + above, by_assimilation, -above / at.carbon_dioxide,
            -vapour_to_carbon * opened / (2 * at.deficit) * at.assimilation / at.carbon_dioxide};
}

Opening leuning(const Stomata& stomata, const AtSurface& at, double factor) {
    const double carbon = at.carbon_dioxide - at.compensation;
    const double by_assimilation = factor * stomata.slope / (carbon * (1 + at.deficit / stomata.deficit_0));
    const double above = by_assimilation * at.assimilation;
    return {stomata.least + above, by_assimilation, -above / carbon, -above / (stomata.deficit_0 + at.deficit)};
}

Opening ball_berry(const Stomata& stomata, const AtSurface& at, double factor) {
    const double humidity = std::max(0.0, 1 - at.deficit / at.saturation);
    const double by_humidity = factor * stomata.slope * at.assimilation / at.carbon_dioxide;
    const double above = by_humidity * humidity;
    return {stomata.least + above, factor * stomata.slope * humidity / at.carbon_dioxide, -above / at.carbon_dioxide,
            humidity > 0 ? -by_humidity / at.saturation : 0};
}

}  // namespace

double Stomata::by_potential(double potential) const {
    if (sensitivity == 0) return 1;
    return (1 + math::exp(sensitivity * reference)) / (1 + math::exp(sensitivity * (reference - potential)));
}

double Stomata::least_at(double potential) const {
    constexpr double width = 0.5;  // MPa
    return potential < dry ? least * math::exp((potential - dry) / width) : least;
}

Stomata Stomata::at_potential(double potential) const {
    Stomata stomata = *this;
    stomata.least = least_at(potential);
    return stomata;
}

Opening Stomata::opening(const AtSurface& surface, double factor) const {
    if (!(surface.assimilation > 0)) return {least, 0, 0, 0};
    AtSurface at = surface;
    const bool is_damp = at.deficit < least_deficit;
    at.deficit = std::max(at.deficit, least_deficit);
    Opening opening = form == Form::medlyn    ? medlyn(*this, at, factor)
                      : form == Form::leuning ? leuning(*this, at, factor)
                                              : ball_berry(*this, at, factor);
    if (is_damp) opening.by_deficit = 0;
    return opening;
}

double Stomata::upper_bound(const AtSurface& surface, double factor, double vapour, double excess) const {
    const double ratio = surface.assimilation / surface.carbon_dioxide;
    if (form == Form::leuning) {
        return least + factor * slope * surface.assimilation / (surface.carbon_dioxide - surface.compensation);
    }
    if (form == Form::ball_berry) return least + factor * slope * ratio;
    // D = excess vapour / (g + vapour), so that g = g0 + c + m sqrt(g + vapour) is a quadratic in the root.
    const double dryness = std::max(excess * vapour, 1e-12);
    const double constant = least + vapour_to_carbon * ratio;
    const double m = vapour_to_carbon * factor * slope * ratio / std::sqrt(dryness);
    const double root = (m + std::sqrt(m * m + 4 * (vapour + constant))) / 2;
    const double damp = constant + vapour_to_carbon * factor * slope * ratio / std::sqrt(least_deficit);
    return std::min(root * root - vapour, damp);
}

}  // namespace espalier::environment::leaf
