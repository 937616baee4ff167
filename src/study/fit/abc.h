// Approximate Bayesian computation: what parameters may have been, from simulations whose statistics are like those
// that were measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::study {

/// Simulations, a row each. Unknowns are told by their normal scores: of the priors, each is normal with mean 0 and
/// deviation 1, and no score is impossible.
struct SimulationTable {
    std::size_t unknowns = 0, statistics = 0;
    std::vector<double> scores;   ///< rows of `unknowns`
    std::vector<double> values;   ///< rows of `statistics`; a row with a NaN failed
    std::vector<double> weights;  ///< density of the priors over that which they were drawn from

    std::size_t rows() const { return weights.size(); }
    std::span<const double> scores_of(std::size_t row) const { return {&scores[row * unknowns], unknowns}; }
    std::span<const double> values_of(std::size_t row) const { return {&values[row * statistics], statistics}; }
};

struct AcceptanceOptions {
    double share = 0.05;        ///< of the simulations that are accepted
    std::size_t at_least = 50;  ///< how many
};

/// A weighted sample.
struct Posterior {
    std::size_t unknowns = 0;
    std::vector<double> scores;     ///< rows of `unknowns`
    std::vector<double> weights;    ///< they add up to 1
    std::vector<std::size_t> rows;  ///< the simulation that each came from

    std::size_t size() const { return weights.size(); }
    std::span<const double> scores_of(std::size_t row) const { return {&scores[row * unknowns], unknowns}; }
};

/// Regression makes one summary for each unknown of all statistics (Fearnhead & Prangle 2012); the simulations whose
/// summaries are nearest to the measured are accepted (Pritchard et al. 1999) and moved by local linear regression to
/// where they would be at the measured ones (Beaumont, Zhang & Balding 2002). Throws UserError if fewer simulations
/// than ten for each unknown did not fail, or nothing differs between them.
Posterior posterior_of(const SimulationTable& simulations, std::span<const double> measured,
                       const AcceptanceOptions& options = {});

/// From where the next generation is drawn: normal distributions about the members of a sample, with twice its
/// covariance (Beaumont, Cornuet, Marin & Robert 2009).
class Proposal {
public:
    explicit Proposal(const Posterior& sample);

    /// `share`, uniform in [0, 1), chooses a member; `deviates` are standard normal, as many as unknowns.
    std::vector<double> draw(double share, std::span<const double> deviates) const;
    /// The priors' density over this one.
    double weight(std::span<const double> scores) const;
    /// Tells it from others.
    std::uint64_t digest() const;

private:
    Posterior sample_;
    std::vector<double> spread_;  ///< lower triangle, row after row, whole rows
    double log_determinant_ = 0;
};

/// The correlation of two unknowns in a sample.
double correlation(const Posterior& sample, std::size_t one, std::size_t other);

/// The value below which lies a share of a weighted sample.
double weighted_quantile(std::span<const double> values, std::span<const double> weights, double share);

}  // namespace espalier::study
