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

/// Errors and correlations, from the curvature of the sum of squares at its minimum. Parameters that change nothing,
/// and those of which only a combination counts, are not decided.
void add_errors(const Problem& problem, const VectorXd& x, double sum_of_squares, LeastSquares& fit) {
    constexpr double nothing = 1e-9, combined = 1e-7;
    const auto count = static_cast<std::size_t>(problem.inputs());
    fit.errors.assign(count, std::nan(""));
    fit.correlations.assign(count, std::vector<double>(count, 0));
    Eigen::MatrixXd jacobian(problem.values(), problem.inputs());
    problem.df(x, jacobian);
    const VectorXd lengths = jacobian.colwise().norm();
    std::vector<int> changing;
    for (int k = 0; k < problem.inputs(); ++k) {
        if (lengths[k] > nothing * lengths.maxCoeff()) changing.push_back(k);
    }
    if (changing.empty() || problem.values() <= problem.inputs()) return;
    const auto size = static_cast<Eigen::Index>(changing.size());
    Eigen::MatrixXd directions(problem.values(), size);
    for (Eigen::Index i = 0; i < size; ++i) directions.col(i) = jacobian.col(changing[i]) / lengths[changing[i]];
    const Eigen::JacobiSVD<Eigen::MatrixXd> parts(directions, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const VectorXd& strengths = parts.singularValues();
    const double variance = sum_of_squares / (problem.values() - problem.inputs());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size), free = covariance;
    for (Eigen::Index k = 0; k < size; ++k) {
        const VectorXd direction = parts.matrixV().col(k);
        const bool is_free = strengths[k] < combined * strengths[0];
        (is_free ? free : covariance) +=
            direction * direction.transpose() * (is_free ? 1 : 1 / (strengths[k] * strengths[k]));
    }
    for (Eigen::Index i = 0; i < size; ++i) {
        const auto own = static_cast<std::size_t>(changing[i]);
        const bool is_decided = free(i, i) < 1e-6;
        if (is_decided)
            fit.errors[own] = std::sqrt(variance * covariance(i, i)) / lengths[changing[i]] * problem.unit(changing[i]);
        for (Eigen::Index j = 0; j < size; ++j) {
            const bool both_free = !is_decided && free(j, j) >= 1e-6;
            const Eigen::MatrixXd& of = both_free ? free : covariance;
            const double scale = std::sqrt(of(i, i) * of(j, j));
            fit.correlations[own][static_cast<std::size_t>(changing[j])] = scale > 0 ? of(i, j) / scale : 0;
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
    add_errors(problem, x, rest.squaredNorm(), fit);
    fit.evaluations = problem.evaluations();
    return fit;
}

}  // namespace espalier::analysis
