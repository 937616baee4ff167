// All that parameters may have been, by approximate Bayesian computation.
#include "espalier/base/error.h"

#include "base/csv_file.h"
#include "study/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::study {
namespace {

constexpr double hardly_told_apart = 0.9;
constexpr double as_wide_as_before = 0.9;  // of the prior's deviation, in normal scores
constexpr std::size_t predicted = 50;      // members of the posterior that are grown again

/// The deviation of the normal scores, in which the prior's is 1.
double deviation_of_scores(const Posterior& posterior, std::size_t unknown) {
    double mean = 0, squares = 0;
    for (std::size_t row = 0; row < posterior.size(); ++row) {
        mean += posterior.weights[row] * posterior.scores_of(row)[unknown];
    }
    for (std::size_t row = 0; row < posterior.size(); ++row) {
        const double away = posterior.scores_of(row)[unknown] - mean;
        squares += posterior.weights[row] * away * away;
    }
    return std::sqrt(squares);
}

FittedParameter summary_of(const FitTask& task, const Posterior& posterior, std::size_t unknown,
                           const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (std::size_t row = 0; row < values.size(); ++row) mean += posterior.weights[row] * values[row];
    for (std::size_t row = 0; row < values.size(); ++row) {
        squares += posterior.weights[row] * (values[row] - mean) * (values[row] - mean);
    }
    const auto at = [&](double share) { return weighted_quantile(values, posterior.weights, share); };
    return {task.unknowns[unknown].name,
            at(0.5),
            std::sqrt(squares),
            at(0.05),
            at(0.95),
            deviation_of_scores(posterior, unknown) < as_wide_as_before};
}

/// What grows from members of the posterior, evenly chosen, in worlds that nothing was fitted to.
std::vector<Prediction> predictions_of(const FitTask& task, const Posterior& posterior, std::uint64_t first,
                                       const FitProgress& progress) {
    const std::vector<Statistic> measured = task.statistics();
    std::vector<std::vector<double>> grown(measured.size());
    std::size_t member = 0;
    double sum = posterior.weights[0];
    for (std::size_t i = 0; i < predicted; ++i) {
        while (sum < (static_cast<double>(i) + 0.5) / predicted && member + 1 < posterior.size()) {
            sum += posterior.weights[++member];
        }
        const std::vector<double> values = values_of(task, posterior.scores_of(member));
        const std::vector<double> found = task.simulated(values, first + i * task.worlds(), task.worlds());
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (std::isfinite(found[k])) grown[k].push_back(found[k]);
        }
        progress({"predicting", i + 1, predicted});
    }
    std::vector<Prediction> predictions;
    for (std::size_t k = 0; k < measured.size(); ++k) {
        const std::vector<double> alike(grown[k].size(), 1);
        const auto at = [&](double share) { return weighted_quantile(grown[k], alike, share); };
        predictions.push_back({measured[k], at(0.5), at(0.05), at(0.95)});
    }
    return predictions;
}

double root_mean_square(const std::vector<Prediction>& predictions) {
    double squares = 0;
    for (const Prediction& one : predictions) {
        const double away = (one.middle - one.measured.value) / one.measured.scale;
        squares += away * away / static_cast<double>(predictions.size());
    }
    return std::sqrt(squares);
}

}  // namespace

std::vector<double> values_of(const FitTask& task, std::span<const double> scores) {
    return values_of_scores(task.unknowns, scores);
}

std::vector<std::vector<double>> columns_of(const FitTask& task, const Posterior& posterior) {
    std::vector<std::vector<double>> columns(task.unknowns.size());
    for (std::size_t row = 0; row < posterior.size(); ++row) {
        const std::vector<double> values = values_of(task, posterior.scores_of(row));
        for (std::size_t k = 0; k < values.size(); ++k) columns[k].push_back(values[k]);
    }
    return columns;
}

std::optional<FitResult> fit_posterior(const FitTask& task, const AbcFitOptions& options, const FitProgress& progress) {
    for (const Unknown& unknown : task.unknowns) {
        if (unknown.prior) continue;
        throw UserError(fmt::format("{} needs a range: --parameter {}=LOW:HIGH, or one in the comment of its #define",
                                    unknown.name, unknown.name));
    }
    std::vector<double> measured;
    for (const Statistic& statistic : task.statistics()) measured.push_back(statistic.value);
    const Simulations simulations(task, options.folder, options.simulations);
    FitResult result;
    std::optional<Proposal> proposal;
    for (std::size_t generation = 0; generation < options.generations; ++generation) {
        const Proposal* const from = proposal ? &*proposal : nullptr;
        const auto tell = [&](std::size_t done, std::size_t all) {
            const std::string number = options.generations > 1 ? fmt::format("generation {}, ", generation + 1) : "";
            progress({number + "simulating", done, all});
        };
        if (!simulations.make(generation, from, options.part, tell)) return std::nullopt;
        if (simulations.made(generation, from) < options.simulations) return std::nullopt;  // others make the rest
        result.posterior = posterior_of(simulations.read(generation, from), measured, {options.accepted});
        proposal.emplace(*result.posterior);
    }
    const std::vector<std::vector<double>> values = columns_of(task, *result.posterior);
    for (std::size_t k = 0; k < task.unknowns.size(); ++k) {
        result.parameters.push_back(summary_of(task, *result.posterior, k, values[k]));
        for (std::size_t other = 0; other < k; ++other) {
            const double together = correlation(*result.posterior, k, other);
            if (std::abs(together) > hardly_told_apart) result.inseparable.push_back({other, k, together});
        }
    }
    const std::size_t simulated = options.generations * options.simulations * task.worlds();
    result.predictions = predictions_of(task, *result.posterior, 1 + simulated, progress);
    result.residual = root_mean_square(result.predictions);
    result.evaluations = simulated + predicted * task.worlds();
    return result;
}

std::string posterior_table(const FitTask& task, const Posterior& posterior) {
    std::string text = "weight";
    for (const Unknown& unknown : task.unknowns) text.append(",").append(csv_text(unknown.name));
    for (std::size_t row = 0; row < posterior.size(); ++row) {
        text.append("\n").append(csv_number(posterior.weights[row]));
        for (const double value : values_of(task, posterior.scores_of(row))) {
            text.append(",").append(csv_number(value));
        }
    }
    return text + "\n";
}

std::string predictive_table(const FitResult& result) {
    std::string text = "statistic,measured,predicted,low,high\n";
    for (const Prediction& one : result.predictions) {
        text += fmt::format("{},{},{},{},{}\n", csv_text(one.measured.name), csv_number(one.measured.value),
                            csv_number(one.middle), csv_number(one.low), csv_number(one.high));
    }
    return text;
}

}  // namespace espalier::study
