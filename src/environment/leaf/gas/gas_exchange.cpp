#include "environment/leaf/gas/gas_exchange.h"

#include "espalier/base/error.h"

#include "environment/leaf/gas/leaf_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment::leaf {
namespace {

LeafInputs<double> inputs_of(const LeafKind& leaf, const LeafLight& light, double potential) {
    return {light.photons,
            light.near_infrared,
            light.thermal,
            potential,
            leaf.photosynthesis.carboxylation.at_25,
            leaf.photosynthesis.electron_transport.at_25,
            leaf.photosynthesis.respiration.at_25,
            leaf.stomata.slope,
            leaf.width};
}

GasExchange told(const LeafResults<double>& found, const LeafKind& leaf, const LeafLight& light, const Air& air) {
    if (!found.is_lost) {
        return {found.assimilation, found.transpiration, found.conductance, found.temperature, found.internal,
                found.at_surface,   found.deficit,       found.sensible,    found.latent,      found.sent};
    }
    throw RunError(fmt::format(
        "a leaf that absorbs {:g} W/m2 in air of {:g} degrees finds no temperature within 60 K of it: its light, its "
        "'width' or the wind cannot be right",
        light.short_wave() + leaf.emissivity * light.thermal, air.temperature));
}

}  // namespace

BoundaryLayer BoundaryLayer::forced(double width, double wind) {
    const double root = std::sqrt(wind / width);
    return {of_heat * root, of_vapour * root};
}

double Residuals::largest() const {
    return std::max({carbon, stomata, vapour, energy});
}

GasExchange gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential) {
    const LeafInputs<double> in = inputs_of(leaf, light, potential);
    return told(SoughtLeaf<double>(leaf, air, in).found(), leaf, light, air);
}

SlopingExchange sloping_gas_exchange(const LeafKind& leaf, const LeafLight& light, const Air& air, double potential) {
    const LeafInputs<double> in = inputs_of(leaf, light, potential);
    SoughtLeaf<double> sought(leaf, air, in);
    const LeafResults<double> found = sought.found();
    return {told(found, leaf, light, air), sought.transpiration_by_potential(found)};
}

GasExchange gas_exchange_at(const LeafKind& leaf, const LeafLight& light, const Air& air, double temperature,
                            double potential) {
    const LeafInputs<double> in = inputs_of(leaf, light, potential);
    SoughtLeaf<double> sought(leaf, air, in);
    sought.hold(temperature);
    return told(sought.found(), leaf, light, air);
}

Residuals residuals_of(const GasExchange& found, const LeafKind& leaf, const LeafLight& light, const Air& air,
                       double potential) {
    const LeafInputs<double> in = inputs_of(leaf, light, potential);
    const LeafResults<double> results{
        found.assimilation, found.transpiration, found.conductance, found.temperature, found.internal, found.at_surface,
        found.deficit,      found.sensible,      found.latent,      found.sent,        false};
    const ResidualsOf<double> residuals = leaf_residuals<double>(leaf, air, in, results);
    return {residuals.carbon, residuals.stomata, residuals.vapour, residuals.energy};
}

}  // namespace espalier::environment::leaf
