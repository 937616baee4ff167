// The air at a leaf, and the physics that leaves, soils and weather share. Temperatures in degrees Celsius, pressures
// in kPa.
#pragma once

namespace espalier::environment::leaf {

inline constexpr double gas_constant = 8.314462618;         ///< J mol-1 K-1
inline constexpr double stefan_boltzmann = 5.670374419e-8;  ///< W m-2 K-4
inline constexpr double kelvin = 273.15;
inline constexpr double molar_heat = 29.3;            ///< of air, J mol-1 K-1 (Campbell & Norman 1998)
inline constexpr double water_molar_mass = 0.018015;  ///< kg mol-1
inline constexpr double water_density = 0.998;        ///< g cm-3
inline constexpr double sea_level = 101.325;          ///< kPa
inline constexpr double vapour_to_carbon = 1.6;       ///< ratio of diffusivities of water vapour and CO2 in still air

struct Air {
    double temperature = 25;
    double vapour_pressure = 1.9;  ///< kPa
    double wind = 1;               ///< m s-1
    double carbon_dioxide = 400;   ///< umol mol-1
    double pressure = sea_level;
};

/// Over water (Tetens' form of FAO-56; Allen et al. 1998, eq. 11).
double saturation_pressure(double temperature);
/// Its slope, kPa K-1 (eq. 13).
double saturation_slope(double temperature);
/// Heat of vaporization, J mol-1: (2.501 - 0.00237 T) MJ kg-1.
double latent_heat(double temperature);
/// What a black body sends from one side, W m-2.
double black_body(double temperature);
/// Of the air at a height above the sea, m (Allen et al. 1998, eq. 7).
double pressure_at_height(double height);

}  // namespace espalier::environment::leaf
