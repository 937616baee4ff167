// Parameters fitted to measurements: the best ones by least squares, or all that may have been by simulation.
#pragma once

#include "espalier/picture/chart_page.h"

#include "study/fit/simulations.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::study {

/// What a fit tells of one parameter.
struct FittedParameter {
    std::string name;
    double value = 0;          ///< the best, or the median
    double error = 0;          ///< standard error, or deviation; NaN: what was measured does not decide it
    double low = 0, high = 0;  ///< 90 % of a posterior lie between; of least squares NaN
    bool is_decided = true;    ///< narrower than what was known before
};

/// Two parameters of which one can grow while the other shrinks.
struct Inseparable {
    std::size_t one = 0, other = 0;
    double correlation = 0;
};

/// What was measured beside what the fitted model gives.
struct Prediction {
    Statistic measured;
    double middle = 0, low = 0, high = 0;  ///< of least squares all the same
};

struct FitResult {
    std::vector<FittedParameter> parameters;
    std::vector<Inseparable> inseparable;
    std::vector<Prediction> predictions;
    double residual = 0;          ///< root mean square, in the scales of the statistics
    std::size_t evaluations = 0;  ///< worlds that were grown
    std::optional<Posterior> posterior;

    std::vector<double> values() const;
    /// What is wrong with a pair, and what helps.
    std::string in_words(const Inseparable& pair) const;
};

/// How far a fit has come.
struct FitState {
    std::string doing;
    std::size_t done = 0, all = 0;
    std::span<const double> best = {};  ///< of least squares, the best values so far; a posterior has none
    double residual = 0;                ///< of these
};
/// Called on the thread that fits.
using FitProgress = std::function<void(const FitState& state)>;

struct LeastSquaresOptions {
    std::size_t worlds = 0;  ///< in which the model grows for each comparison; 0: as many as were measured, but 8 if
                             ///< it draws random numbers
    std::size_t search = 0;  ///< comparisons of the search before; 0: 50 for each parameter that has bounds
};

/// A search over the whole of the bounds (DIRECT-L: Gablonsky & Kelley 2001), a search without derivatives from its
/// best (Sbplx: Rowan 1990), and Levenberg and Marquardt's steps, which give the errors. All comparisons use the same
/// random numbers. Parameters that have no bounds are only searched from their start.
FitResult fit_least_squares(const FitTask& task, const LeastSquaresOptions& options, const FitProgress& progress);

struct AbcFitOptions {
    std::size_t simulations = 1000;  ///< of each generation
    std::size_t generations = 1;
    double accepted = 0.05;
    std::filesystem::path folder;  ///< where simulations are kept
    Part part = {};
};

/// None if it was interrupted, or made a part only.
std::optional<FitResult> fit_posterior(const FitTask& task, const AbcFitOptions& options, const FitProgress& progress);

/// Densities of the parameters before and after, pairs of them, and what was measured beside what is predicted.
ChartPage page_of(const FitTask& task, const FitResult& result, const std::string& title, bool dark);

/// posterior.csv, and predictive.csv: what was measured beside what is predicted.
std::string posterior_table(const FitTask& task, const Posterior& posterior);
std::string predictive_table(const FitResult& result);

/// Values of the parameters of a member of a posterior.
std::vector<double> values_of(const FitTask& task, std::span<const double> scores);
/// The same of all members, a column for each parameter.
std::vector<std::vector<double>> columns_of(const FitTask& task, const Posterior& posterior);

}  // namespace espalier::study
