#include "environment/leaf/gas/penman_monteith.h"

namespace espalier::environment::leaf {

double penman_monteith(const LeafKind& leaf, const LeafLight& light, const Air& air, double conductance) {
    const BoundaryLayer layer = BoundaryLayer::forced(leaf.width, air.wind);
    const double sent = 2 * leaf.emissivity * black_body(air.temperature);
    const double net = light.short_wave() + leaf.emissivity * light.thermal - sent;  // if it were as warm as the air
    const double radiative = 4 * sent / (air.temperature + kelvin) / molar_heat;
    const double heat = 2 * layer.heat + radiative;
    const double vapour = conductance * layer.vapour / (conductance + layer.vapour);
    const double latent = latent_heat(air.temperature);
    const double slope = saturation_slope(air.temperature) / air.pressure;
    const double deficit = (saturation_pressure(air.temperature) - air.vapour_pressure) / air.pressure;
    // Both sides of s + gamma gH / gv times gv, so that shut stomata let nothing through.
    return vapour * (slope * net + molar_heat * heat * deficit) / (slope * latent * vapour + molar_heat * heat);
}

}  // namespace espalier::environment::leaf
