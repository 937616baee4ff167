#include "environment/leaf/gas/air.h"

#include "espalier/base/math.h"

namespace espalier::environment::leaf {

double saturation_pressure(double temperature) {
    return 0.6108 * math::exp(17.27 * temperature / (temperature + 237.3));
}

double saturation_slope(double temperature) {
    return 4098 * saturation_pressure(temperature) / ((temperature + 237.3) * (temperature + 237.3));
}

double latent_heat(double temperature) {
    return (2.501e6 - 2370 * temperature) * water_molar_mass;
}

double black_body(double temperature) {
    const double square = (temperature + kelvin) * (temperature + kelvin);
    return stefan_boltzmann * square * square;
}

double pressure_at_height(double height) {
    return 101.3 * math::pow((293 - 0.0065 * height) / 293, 5.26);
}

}  // namespace espalier::environment::leaf
