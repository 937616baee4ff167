// Weights of the four control points of a stretch of a uniform cubic B-spline (de Boor 1978).
#pragma once

#include <array>

namespace espalier {

/// Six times the weights at u, 0 to 1 along the stretch.
inline std::array<double, 4> b_spline_sixths(double u) {
    const double v = 1 - u;
    return {v * v * v, 3 * u * u * u - 6 * u * u + 4, -3 * u * u * u + 3 * u * u + 3 * u + 1, u * u * u};
}

/// The weights at u; their sum is 1.
inline std::array<double, 4> b_spline_weights(double u) {
    const auto [a, b, c, d] = b_spline_sixths(u);
    return {a / 6, b / 6, c / 6, d / 6};
}

/// The derivatives of the weights by u.
inline std::array<double, 4> b_spline_slopes(double u) {
    const double v = 1 - u;
    return {-v * v / 2, (3 * u * u - 4 * u) / 2, (-3 * u * u + 2 * u + 1) / 2, u * u / 2};
}

}  // namespace espalier
