#include "environment/soil/hydraulics/texture_library.h"

#include "espalier/base/math.h"

#include <vector>

namespace espalier::environment {
namespace {

SoilKind soil_of(double residual, double saturated, double alpha, double n, double conductivity, double l = 0.5) {
    return {SoilKind::Model::van_genuchten, residual, saturated, alpha, n, conductivity, l};
}

/// By the decimal logarithms of alpha, n and ks, as they are published.
SoilKind rosetta(double residual, double saturated, double alpha, double n, double conductivity) {
    const auto number = [](double logarithm) { return math::any_power(10, logarithm); };
    return soil_of(residual, saturated, number(alpha), number(n), number(conductivity));
}

const std::vector<NamedSoil>& soils() {
    static const std::vector<NamedSoil> all = {
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
        {"rosetta sand", rosetta(0.053, 0.375, -1.453, 0.502, 2.808)},
        {"rosetta loamy sand", rosetta(0.049, 0.390, -1.459, 0.242, 2.022)},
        {"rosetta sandy loam", rosetta(0.039, 0.387, -1.574, 0.161, 1.583)},
        {"rosetta loam", rosetta(0.061, 0.399, -1.954, 0.168, 1.081)},
        {"rosetta silt", rosetta(0.050, 0.489, -2.182, 0.225, 1.641)},
        {"rosetta silt loam", rosetta(0.065, 0.439, -2.296, 0.221, 1.261)},
        {"rosetta sandy clay loam", rosetta(0.063, 0.384, -1.676, 0.124, 1.120)},
        {"rosetta clay loam", rosetta(0.079, 0.442, -1.801, 0.151, 0.913)},
        {"rosetta silty clay loam", rosetta(0.090, 0.482, -2.076, 0.182, 1.046)},
        {"rosetta sandy clay", rosetta(0.117, 0.385, -1.476, 0.082, 1.055)},
        {"rosetta silty clay", rosetta(0.111, 0.481, -1.790, 0.121, 0.983)},
        {"rosetta clay", rosetta(0.098, 0.459, -1.825, 0.098, 1.169)},
    };
    return all;
}

}  // namespace

std::span<const NamedSoil> texture_library() {
    return soils();
}

// Soil Survey Division Staff 1993, chapter 3.
std::string_view texture_class(double sand, double clay) {
    const double silt = 100 - sand - clay;
    if (clay >= 40) return silt >= 40 ? "silty clay" : sand > 45 ? "sandy clay" : "clay";
    if (clay >= 35 && sand > 45) return "sandy clay";
    if (clay >= 27 && sand <= 45) return sand <= 20 ? "silty clay loam" : "clay loam";
    if (clay >= 20 && silt < 28) return "sandy clay loam";
    if (silt >= 80 && clay < 12) return "silt";
    if (silt >= 50) return "silt loam";
    if (silt + 1.5 * clay < 15) return "sand";
    if (silt + 2 * clay < 30) return "loamy sand";
    const bool is_loam = clay >= 7 && silt >= 28 && sand <= 52;
    return is_loam ? "loam" : "sandy loam";
}

}  // namespace espalier::environment
