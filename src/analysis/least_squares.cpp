#include "analysis/least_squares.h"

#include "espalier/base/error.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

namespace espalier::analysis {
namespace {

using Eigen::VectorXd;

/// Residuals of parameters in their own units: changes of 1 are changes of a start value by itself.
class Problem {
public:
    using Scalar = double;
    using InputType = VectorXd;
    using ValueType = VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    Problem(const std::vector<FreeParameter>& parameters, const Residuals& residuals)
        : parameters_(parameters), residuals_(residuals), count_(at(VectorXd::Zero(inputs())).size()) {}

    int inputs() const { return static_cast<int>(parameters_.size()); }
    int values() const { return static_cast<int>(count_); }
    int evaluations() const { return evaluations_; }

    int operator()(const VectorXd& x, VectorXd& result) const {
        const std::vector<double> found = at(x);
        result = Eigen::Map<const VectorXd>(found.data(), values());
        return 0;
    }

    /// By central differences that stay within the bounds.
    int df(const VectorXd& x, Eigen::MatrixXd& jacobian) const {
        constexpr double step = 1e-5;
        for (int k = 0; k < inputs(); ++k) {
            VectorXd low = x, high = x;
            low[k] -= step;
            high[k] += step;
            VectorXd before(values()), after(values());
            (*this)(low, before);
            (*this)(high, after);
            const double width = (value(k, high[k]) - value(k, low[k])) / unit(k);
            jacobian.col(k) = width > 0 ? ((after - before) / width).eval() : VectorXd::Zero(values());
        }
        return 0;
    }

    double unit(int k) const {
        const double start = std::abs(parameters_[static_cast<std::size_t>(k)].start);
        return start > 0 ? start : 1;
    }
    double value(int k, double x) const {
        const FreeParameter& parameter = parameters_[static_cast<std::size_t>(k)];
        return std::clamp(parameter.start + x * unit(k), parameter.lowest, parameter.highest);
    }

private:
    std::vector<double> at(const VectorXd& x) const {
        std::vector<double> all;
        for (int k = 0; k < inputs(); ++k) all.push_back(value(k, x[k]));
        ++evaluations_;
        return residuals_(all);
    }

    const std::vector<FreeParameter>& parameters_;
    const Residuals& residuals_;
    mutable int evaluations_ = 0;
    std::size_t count_;
};

/// Standard errors and their correlations, from the curvature of the sum of squares at its minimum: of the parameters
/// that move a residual.
void add_errors(LeastSquares& fit, const Problem& problem, const VectorXd& x, double sum_of_squares) {
    Eigen::MatrixXd jacobian(problem.values(), problem.inputs());
    problem.df(x, jacobian);
    fit.errors.assign(fit.values.size(), std::nan(""));
    std::vector<int> moving;
    const double most = jacobian.colwise().squaredNorm().maxCoeff();
    for (int k = 0; k < problem.inputs(); ++k) {
        if (jacobian.col(k).squaredNorm() > 1e-16 * most) moving.push_back(k);
    }
    if (moving.empty() || problem.values() <= problem.inputs()) return;
    const Eigen::MatrixXd slopes = jacobian(Eigen::all, moving);
    const Eigen::FullPivLU<Eigen::MatrixXd> curvature(slopes.transpose() * slopes);
    if (!curvature.isInvertible()) return;
    const Eigen::MatrixXd covariance = curvature.inverse() * (sum_of_squares / (problem.values() - problem.inputs()));
    const VectorXd errors = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    const VectorXd widths = curvature.inverse().diagonal().cwiseMax(0).cwiseSqrt();
    fit.correlations.assign(fit.values.size() * fit.values.size(), 0);
    for (std::size_t i = 0; i < moving.size(); ++i) {
        const auto k = static_cast<std::size_t>(moving[i]);
        fit.errors[k] = errors[static_cast<int>(i)] * problem.unit(moving[i]);
        for (std::size_t j = 0; j < moving.size(); ++j) {
            const double product = widths[static_cast<int>(i)] * widths[static_cast<int>(j)];
            if (!(product > 0)) continue;
            fit.correlations[k * fit.values.size() + static_cast<std::size_t>(moving[j])] =
                curvature.inverse()(static_cast<int>(i), static_cast<int>(j)) / product;
        }
    }
}

}  // namespace

LeastSquares fit_least_squares(const std::vector<FreeParameter>& parameters, const Residuals& residuals) {
    Problem problem(parameters, residuals);
    if (problem.values() < problem.inputs()) {
        throw UserError(fmt::format("{} measures cannot decide {} parameters: mark more, or fit fewer",
                                    problem.values(), problem.inputs()));
    }
    VectorXd x = VectorXd::Zero(problem.inputs());
    Eigen::LevenbergMarquardt<Problem> solver(problem);
    solver.parameters.maxfev = 400;
    solver.minimize(x);
    LeastSquares fit;
    for (int k = 0; k < problem.inputs(); ++k) fit.values.push_back(problem.value(k, x[k]));
    VectorXd rest(problem.values());
    problem(x, rest);
    fit.residual = std::sqrt(rest.squaredNorm() / problem.values());
    add_errors(fit, problem, x, rest.squaredNorm());
    fit.evaluations = problem.evaluations();
    return fit;
}

}  // namespace espalier::analysis
