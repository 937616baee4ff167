// A straight line through points, by least squares.
#pragma once

#include <span>

namespace espalier::analysis {

/// y = intercept + slope x. `error` is the slope's standard error; NaN with fewer than three points.
struct LineFit {
    double slope, intercept, error;
};
/// NaN with fewer than two different x.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace espalier::analysis
