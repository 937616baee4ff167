#include "environment/soil/texture_library.h"

namespace espalier::environment {
namespace {

constexpr SoilKind soil_of(double residual, double saturated, double alpha, double n, double conductivity,
                           double l = 0.5) {
    return {SoilKind::Model::van_genuchten, residual, saturated, alpha, n, conductivity, l};
}

constexpr NamedSoil soils[] = {
    {"sand", soil_of(0.045, 0.43, 0.145, 2.68, 712.8)},
    {"loamy sand", soil_of(0.057, 0.41, 0.124, 2.28, 350.2)},
    {"sandy loam", soil_of(0.065, 0.41, 0.075, 1.89, 106.1)},
    {"loam", soil_of(0.078, 0.43, 0.036, 1.56, 24.96)},
    {"silt", soil_of(0.034, 0.46, 0.016, 1.37, 6.0)},
    {"silt loam", soil_of(0.067, 0.45, 0.020, 1.41, 10.8)},
    {"sandy clay loam", soil_of(0.100, 0.39, 0.059, 1.48, 31.44)},
    {"clay loam", soil_of(0.095, 0.41, 0.019, 1.31, 6.24)},
    {"silty clay loam", soil_of(0.089, 0.43, 0.010, 1.23, 1.68)},
    {"sandy clay", soil_of(0.100, 0.38, 0.027, 1.23, 2.88)},
    {"silty clay", soil_of(0.070, 0.36, 0.005, 1.09, 0.48)},
    {"clay", soil_of(0.068, 0.38, 0.008, 1.09, 4.8)},
    {"hypres topsoil coarse", soil_of(0.025, 0.403, 0.0383, 1.3774, 60.0, 1.25)},
    {"hypres topsoil medium", soil_of(0.010, 0.439, 0.0314, 1.1804, 12.061, -2.3421)},
    {"hypres topsoil medium fine", soil_of(0.010, 0.430, 0.0083, 1.2539, 2.272, -0.5884)},
    {"hypres topsoil fine", soil_of(0.010, 0.520, 0.0367, 1.1012, 24.8, -1.9772)},
    {"hypres topsoil very fine", soil_of(0.010, 0.614, 0.0265, 1.1033, 15.0, 2.5)},
    {"hypres subsoil coarse", soil_of(0.025, 0.366, 0.0430, 1.5206, 70.0, 1.25)},
    {"hypres subsoil medium", soil_of(0.010, 0.392, 0.0249, 1.1689, 10.755, -0.7437)},
    {"hypres subsoil medium fine", soil_of(0.010, 0.412, 0.0082, 1.2179, 4.0, 0.5)},
    {"hypres subsoil fine", soil_of(0.010, 0.481, 0.0198, 1.0861, 8.5, -3.7124)},
    {"hypres subsoil very fine", soil_of(0.010, 0.538, 0.0168, 1.0730, 8.235, 0.0001)},
};

}  // namespace

std::span<const NamedSoil> texture_library() {
    return soils;
}

}  // namespace espalier::environment
