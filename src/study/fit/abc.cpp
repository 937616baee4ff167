#include "study/fit/abc.h"

#include "espalier/base/error.h"
#include "espalier/base/math.h"
#include "espalier/base/read_log.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

namespace espalier::study {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = std::vector<std::size_t>;

constexpr std::size_t simulations_per_unknown = 10;
constexpr double ridge = 1e-4;  // of a statistic's variance: what two statistics say alike is divided among them

Eigen::Index index(std::size_t number) {
    return static_cast<Eigen::Index>(number);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Rows succeeded(const SimulationTable& simulations) {
    Rows rows;
    for (std::size_t row = 0; row < simulations.rows(); ++row) {
        const auto values = simulations.values_of(row);
        const auto is_finite = [](double value) { return std::isfinite(value); };
        if (std::all_of(values.begin(), values.end(), is_finite)) rows.push_back(row);
    }
    return rows;
}

/// Statistics in units of their spread, far ones drawn in; those that are alike in all simulations are left out. Row i
/// is that of rows[i], the last is the measured.
MatrixXd in_units(const SimulationTable& simulations, const Rows& rows, std::span<const double> measured) {
    MatrixXd units(index(rows.size() + 1), index(simulations.statistics));
    Eigen::Index columns = 0;
    for (std::size_t k = 0; k < simulations.statistics; ++k) {
        std::vector<double> values, differences;
        for (const std::size_t row : rows) values.push_back(simulations.values_of(row)[k]);
        const double middle = median(values);
        double mean_difference = 0;
        for (const double value : values) {
            differences.push_back(std::abs(value - middle));
            mean_difference += differences.back() / static_cast<double>(values.size());
        }
        const double deviation = median(differences), unit = deviation > 0 ? deviation : mean_difference;
        if (!(unit > 0)) continue;
        for (std::size_t i = 0; i < rows.size(); ++i)
            units(index(i), columns) = std::asinh((values[i] - middle) / unit);
        units(index(rows.size()), columns++) = std::asinh((measured[k] - middle) / unit);
    }
    return units.leftCols(columns);
}

/// Numbers of the rows that are nearest to the last one, the nearest first; equal ones in their order.
Rows nearest(const MatrixXd& places, std::size_t count) {
    const Eigen::Index last = places.rows() - 1;
    const VectorXd distances = (places.topRows(last).rowwise() - places.row(last)).rowwise().squaredNorm();
    Rows rows(static_cast<std::size_t>(last));
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t a, std::size_t b) { return distances[index(a)] < distances[index(b)]; });
    rows.resize(std::min(count, rows.size()));
    return rows;
}

/// Columns of `results` as linear functions of `causes`, with a constant, by weighted least squares.
class LinearModel {
public:
    LinearModel(const MatrixXd& causes, const MatrixXd& results, const VectorXd& weights) {
        const double total = weights.sum();
        mean_causes_ = weights.transpose() * causes / total;
        mean_results_ = weights.transpose() * results / total;
        const MatrixXd x = causes.rowwise() - mean_causes_, y = results.rowwise() - mean_results_;
        MatrixXd squares = x.transpose() * weights.asDiagonal() * x;
        squares.diagonal().array() += ridge * squares.diagonal().mean() + 1e-300;
        slopes_ = squares.ldlt().solve(x.transpose() * weights.asDiagonal() * y);
    }
    MatrixXd at(const MatrixXd& causes) const {
        return ((causes.rowwise() - mean_causes_) * slopes_).rowwise() + mean_results_;
    }
    const MatrixXd& slopes() const { return slopes_; }

private:
    Eigen::RowVectorXd mean_causes_, mean_results_;
    MatrixXd slopes_;
};

MatrixXd chosen_rows(const MatrixXd& matrix, const Rows& rows) {
    MatrixXd chosen(index(rows.size()), matrix.cols());
    for (std::size_t i = 0; i < rows.size(); ++i) chosen.row(index(i)) = matrix.row(index(rows[i]));
    return chosen;
}

MatrixXd scores_of(const SimulationTable& simulations, const Rows& rows) {
    MatrixXd scores(index(rows.size()), index(simulations.unknowns));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t k = 0; k < simulations.unknowns; ++k) {
            scores(index(i), index(k)) = simulations.scores_of(rows[i])[k];
        }
    }
    return scores;
}

VectorXd weights_of(const SimulationTable& simulations, const Rows& rows) {
    VectorXd weights(index(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) weights[index(i)] = simulations.weights[rows[i]];
    return weights;
}

Rows rows_of(const Rows& of, const Rows& numbers) {
    Rows rows;
    for (const std::size_t number : numbers) rows.push_back(of[number]);
    return rows;
}

/// A column for each unknown: what the statistics and their squares say of it, in units of its deviation. What it is
/// must not depend on what was measured, or intervals would not hold the truth as often as they say.
MatrixXd summaries(const SimulationTable& simulations, const Rows& rows, const MatrixXd& units) {
    MatrixXd causes(units.rows(), 2 * units.cols());
    causes << units, units.cwiseProduct(units);
    const Eigen::Index simulated = units.rows() - 1;
    const LinearModel model(causes.topRows(simulated), scores_of(simulations, rows), VectorXd::Ones(simulated));
    MatrixXd found = model.at(causes);
    for (Eigen::Index k = 0; k < found.cols(); ++k) {
        const auto of_simulated = found.col(k).head(simulated).array();
        const double deviation = std::sqrt((of_simulated - of_simulated.mean()).square().mean());
        if (deviation > 0) found.col(k) /= deviation;
    }
    return found;
}

}  // namespace

Posterior posterior_of(const SimulationTable& simulations, std::span<const double> measured,
                       const AcceptanceOptions& options) {
    const Rows rows = succeeded(simulations);
    if (rows.size() < simulations_per_unknown * simulations.unknowns) {
        throw UserError(fmt::format("{} of {} simulations have all the statistics that were measured; {} are needed",
                                    rows.size(), simulations.rows(), simulations_per_unknown * simulations.unknowns));
    }
    const MatrixXd units = in_units(simulations, rows, measured);
    if (units.cols() == 0) throw UserError("no statistic differs between the simulations: nothing decides a parameter");
    const auto share_of = [&](double share) {
        return std::max(options.at_least, static_cast<std::size_t>(share * static_cast<double>(rows.size())));
    };
    const MatrixXd told = summaries(simulations, rows, units);
    const Rows accepted = nearest(told, share_of(options.share));

    const MatrixXd here = chosen_rows(told, accepted);
    const MatrixXd away = here.rowwise() - told.row(told.rows() - 1);
    const VectorXd squares = away.rowwise().squaredNorm();
    const double farthest = squares.maxCoeff() * (1 + 1e-9) + 1e-300;
    VectorXd weights = weights_of(simulations, rows_of(rows, accepted));
    weights.array() *= 1 - squares.array() / farthest;  // Epanechnikov's kernel
    MatrixXd scores = scores_of(simulations, rows_of(rows, accepted));
    scores -= away * LinearModel(away, scores, weights).slopes();

    Posterior posterior{simulations.unknowns, {}, {}, rows_of(rows, accepted)};
    for (std::size_t i = 0; i < accepted.size(); ++i) {
        posterior.weights.push_back(weights[index(i)] / weights.sum());
        for (std::size_t k = 0; k < simulations.unknowns; ++k) {
            posterior.scores.push_back(scores(index(i), index(k)));
        }
    }
    return posterior;
}

namespace {

MatrixXd covariance_of(const Posterior& sample) {
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> scores(
        sample.scores.data(), index(sample.size()), index(sample.unknowns));
    const Eigen::Map<const VectorXd> weights(sample.weights.data(), index(sample.size()));
    const Eigen::RowVectorXd mean = weights.transpose() * scores;
    const MatrixXd away = scores.rowwise() - mean;
    return away.transpose() * weights.asDiagonal() * away;
}

}  // namespace

Proposal::Proposal(const Posterior& sample) : sample_(sample) {
    MatrixXd covariance = 2 * covariance_of(sample);
    covariance.diagonal().array() += 1e-8;
    const MatrixXd lower = covariance.llt().matrixL();
    for (Eigen::Index row = 0; row < lower.rows(); ++row) {
        log_determinant_ += math::log(lower(row, row));
        for (Eigen::Index column = 0; column < lower.cols(); ++column) spread_.push_back(lower(row, column));
    }
}

std::vector<double> Proposal::draw(double share, std::span<const double> deviates) const {
    std::size_t member = 0;
    for (double sum = sample_.weights[0]; sum <= share && member + 1 < sample_.size();) {
        sum += sample_.weights[++member];
    }
    const auto about = sample_.scores_of(member);
    std::vector<double> scores(about.begin(), about.end());
    for (std::size_t i = 0; i < scores.size(); ++i) {
        for (std::size_t k = 0; k <= i; ++k) scores[i] += spread_[i * scores.size() + k] * deviates[k];
    }
    return scores;
}

double Proposal::weight(std::span<const double> scores) const {
    double density = 0, of_priors = 0;
    for (const double score : scores) of_priors -= score * score / 2;
    for (std::size_t member = 0; member < sample_.size(); ++member) {
        const auto about = sample_.scores_of(member);
        std::vector<double> away(scores.size());
        double squares = 0;
        for (std::size_t i = 0; i < scores.size(); ++i) {  // forward substitution
            away[i] = scores[i] - about[i];
            for (std::size_t k = 0; k < i; ++k) away[i] -= spread_[i * scores.size() + k] * away[k];
            away[i] /= spread_[i * scores.size() + i];
            squares += away[i] * away[i];
        }
        density += sample_.weights[member] * math::exp(-squares / 2 - log_determinant_);
    }
    return density > 0 ? math::exp(of_priors) / density : 0;
}

std::uint64_t Proposal::digest() const {
    const auto bytes = [](const std::vector<double>& numbers) {
        return std::string_view(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
    };
    return espalier::digest(bytes(sample_.weights), espalier::digest(bytes(sample_.scores)));
}

double correlation(const Posterior& sample, std::size_t one, std::size_t other) {
    const MatrixXd covariance = covariance_of(sample);
    const double variances = covariance(index(one), index(one)) * covariance(index(other), index(other));
    return variances > 0 ? covariance(index(one), index(other)) / std::sqrt(variances) : 0;
}

double weighted_quantile(std::span<const double> values, std::span<const double> weights, double share) {
    Rows order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    const double wanted = share * std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    for (const std::size_t row : order) {
        sum += weights[row];
        if (sum >= wanted) return values[row];
    }
    return values.empty() ? std::nan("") : values[order.back()];
}

}  // namespace espalier::study
