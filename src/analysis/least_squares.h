// Nonlinear least squares: parameters whose residuals are small (Levenberg 1944, Marquardt 1963).
#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace espalier::analysis {

struct FreeParameter {
    double start = 0;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
};

struct LeastSquares {
    std::vector<double> values;  ///< values of the parameters
    std::vector<double> errors;  ///< standard errors; NaN where the residuals do not decide a parameter
    /// Of two parameters, how much a change of one makes up for that of the other: 1 or -1 where it does wholly, so
    /// that the residuals tell only one of the two. 0 with a parameter that changes no residual.
    std::vector<std::vector<double>> correlations;
    double residual = 0;  ///< root mean square
    int evaluations = 0;
};

/// As many residuals for all values of the parameters.
using Residuals = std::function<std::vector<double>(const std::vector<double>& values)>;

/// From `start`, within the bounds. Throws UserError if there are fewer residuals than parameters.
LeastSquares fit_least_squares(const std::vector<FreeParameter>& parameters, const Residuals& residuals);

}  // namespace espalier::analysis
