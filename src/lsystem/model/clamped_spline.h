// A point of a clamped cubic B-spline: its ends are the first and the last control point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace espalier::lsystem {

constexpr std::size_t least_control_points = 4;

/// De Boor's recurrence (de Boor 1972) with knots 0, 0, 0, 0, 1, 2, ..., n, n, n, n of n segments. `points` are the
/// four of the segment that `u` lies in.
template <class Point>
Point clamped_spline(std::array<Point, 4> points, int segment, int segments, double u) {
    const auto knot = [&](int k) { return double(std::clamp(k - 3, 0, segments)); };
    for (int degree = 1; degree <= 3; ++degree) {
        for (int k = 3; k >= degree; --k) {
            const double from = knot(segment + k), to = knot(segment + k + 4 - degree);
            const double share = (u - from) / (to - from);
            points[std::size_t(k)] = (1 - share) * points[std::size_t(k) - 1] + share * points[std::size_t(k)];
        }
    }
    return points[3];
}

}  // namespace espalier::lsystem
