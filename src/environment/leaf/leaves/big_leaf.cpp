#include "environment/leaf/leaves/big_leaf.h"

#include "environment/leaf/gas/penman_monteith.h"
#include "environment/leaf/leaves/units.h"

namespace espalier::environment::leaf {
namespace {

double mean_over_area(const PlantLeaves& leaves, const auto& of) {
    double sum = 0, area = 0;
    for (std::size_t row = 0; row < leaves.size(); ++row) {
        sum += leaves.area[row] * of(row);
        area += leaves.area[row];
    }
    return sum / area;
}

void take_own_parameters(LeafKind& kind, const PlantLeaves& leaves) {
    const auto take = [&](OwnParameter parameter, double& usual) {
        const double of_kind = usual;
        usual = mean_over_area(leaves, [&](std::size_t row) { return leaves.own_or(parameter, row, of_kind); });
    };
    take(OwnParameter::v, kind.photosynthesis.carboxylation.at_25);
    take(OwnParameter::jmax, kind.photosynthesis.electron_transport.at_25);
    take(OwnParameter::rd, kind.photosynthesis.respiration.at_25);
    take(OwnParameter::g1, kind.stomata.slope);
    take(OwnParameter::width, kind.width);
}

}  // namespace

BigLeaf big_leaf(const PlantLeaves& leaves, LeafKind kind, const Air& air, double thermal) {
    if (leaves.size() == 0) return {};
    take_own_parameters(kind, leaves);
    const auto mean_of = [&](const auto& column) {
        return mean_over_area(leaves, [&](std::size_t row) { return static_cast<double>(column[row]); });
    };
    const auto mean_light = [&](const std::vector<float>& sun, const std::vector<float>& shade) {
        return mean_over_area(leaves, [&](std::size_t row) {
            return double(shade[row]) + double(leaves.sunlit[row]) * (double(sun[row]) - double(shade[row]));
        });
    };
    if (!leaves.thermal.empty()) thermal = mean_of(leaves.thermal);
    const LeafLight light{mean_light(leaves.sun_photons, leaves.shade_photons),
                          mean_light(leaves.sun_near_infrared, leaves.shade_near_infrared), thermal};
    const LeafLight dark{0, 0, thermal};
    const double potential = mean_of(leaves.potential), lit = mean_of(leaves.lit);
    const GasExchange in_light = gas_exchange(kind, light, air, potential);
    const GasExchange unlit = gas_exchange(kind, dark, air, potential);
    double whole = 0;
    for (const double one : leaves.area) whole += one;
    const double open = mean_of(leaves.state[conductance]);
    const auto over_step = [&](double by_light, double in_the_dark) {
        return lit * by_light + (1 - lit) * in_the_dark;
    };
    return {
        1e-6 * seconds_per_day * whole * over_step(in_light.assimilation, unlit.assimilation),
        cm3_of_mole * seconds_per_day * whole * over_step(in_light.transpiration, unlit.transpiration),
        cm3_of_mole * seconds_per_day * whole *
            over_step(penman_monteith(kind, light, air, open), penman_monteith(kind, dark, air, unlit.conductance))};
}

}  // namespace espalier::environment::leaf
