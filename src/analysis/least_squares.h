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
    double residual = 0;         ///< root mean square
    int evaluations = 0;
    std::vector<double> correlations;  ///< of the errors, a row for each parameter; empty if none is known

    /// 0 where it is not known.
    double correlation(std::size_t one, std::size_t other) const {
        return correlations.empty() ? 0 : correlations[one * values.size() + other];
    }
};

/// As many residuals for all values of the parameters.
using Residuals = std::function<std::vector<double>(const std::vector<double>& values)>;

/// From `start`, within the bounds. Throws UserError if there are fewer residuals than parameters.
LeastSquares fit_least_squares(const std::vector<FreeParameter>& parameters, const Residuals& residuals);

}  // namespace espalier::analysis
