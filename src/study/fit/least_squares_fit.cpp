// The best parameters by least squares.
#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "analysis/least_squares.h"
#include "study/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <nlopt.h>
#include <type_traits>

namespace espalier::study {
namespace {

constexpr std::size_t usual_worlds = 8, comparisons_per_parameter = 50;
constexpr double hardly_told_apart = 0.95;
constexpr double failed = 1e6;  // a residual of growth that failed

/// Sums of squares of the differences between what was measured and what grows, all with the same random numbers.
class Comparison {
public:
    Comparison(const FitTask& task, std::size_t worlds, std::size_t expected, const FitProgress& progress)
        : task_(task), worlds_(worlds), expected_(expected), measured_(task.statistics()), progress_(progress) {}

    std::vector<double> residuals(const std::vector<double>& values) {
        end_if_asked();
        std::vector<double> residuals;
        const std::vector<double> grown = task_.simulated(values, 0, worlds_);
        for (std::size_t i = 0; i < measured_.size(); ++i) {
            const double residual = (grown[i] - measured_[i].value) / measured_[i].scale;
            residuals.push_back(std::isfinite(residual) ? residual : failed);
        }
        note(values, residuals);
        return residuals;
    }
    double sum_of_squares(const std::vector<double>& values) {
        double sum = 0;
        for (const double residual : residuals(values)) sum += residual * residual;
        return sum;
    }
    std::size_t worlds_grown() const { return comparisons_ * worlds_; }

private:
    void note(const std::vector<double>& values, const std::vector<double>& residuals) {
        double sum = 0;
        for (const double residual : residuals) sum += residual * residual;
        const double mean = std::sqrt(sum / static_cast<double>(residuals.size()));
        if (best_.empty() || mean < least_) least_ = mean, best_ = values;
        progress_({"comparing", std::min(++comparisons_, expected_), expected_, best_, least_});
    }

    const FitTask& task_;
    std::size_t worlds_, expected_, comparisons_ = 0;
    std::vector<double> best_;  ///< so far
    double least_ = 0;          ///< residual of these
    std::vector<Statistic> measured_;
    const FitProgress& progress_;
};

bool has_bounds(const Unknown& unknown) {
    return std::isfinite(unknown.lowest) && std::isfinite(unknown.highest);
}

double in_bounds(const Unknown& unknown, double value) {
    const double number = unknown.prior && unknown.prior->is_whole() ? std::round(value) : value;
    return std::clamp(number, unknown.lowest, unknown.highest);
}

/// What NLopt is handed, which knows no exceptions.
struct Searched {
    const FitTask& task;
    Comparison& comparison;
    nlopt_opt search;
    std::exception_ptr thrown = {};

    static double sum_of_squares(unsigned count, const double* at, double* /*gradient*/, void* with) {
        auto& self = *static_cast<Searched*>(with);
        std::vector<double> values;
        for (std::size_t k = 0; k < count; ++k) values.push_back(in_bounds(self.task.unknowns[k], at[k]));
        try {
            return self.comparison.sum_of_squares(values);
        } catch (...) {
            self.thrown = std::current_exception();
            nlopt_force_stop(self.search);
            return failed * failed;
        }
    }
};

/// One of NLopt's searches, of those that ask for no derivative and draw no random numbers.
void search(nlopt_algorithm algorithm, const FitTask& task, Comparison& comparison, std::size_t comparisons,
            std::vector<double>& values) {
    const std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)> search(
        nlopt_create(algorithm, static_cast<unsigned>(values.size())), nlopt_destroy);
    std::vector<double> step;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Unknown& unknown = task.unknowns[k];
        nlopt_set_lower_bound(search.get(), static_cast<int>(k), unknown.lowest);
        nlopt_set_upper_bound(search.get(), static_cast<int>(k), unknown.highest);
        step.push_back(0.05 * (unknown.highest - unknown.lowest));
    }
    Searched searched{task, comparison, search.get()};
    nlopt_set_min_objective(search.get(), Searched::sum_of_squares, &searched);
    nlopt_set_initial_step(search.get(), step.data());
    nlopt_set_maxeval(search.get(), static_cast<int>(comparisons));
    nlopt_set_ftol_rel(search.get(), 1e-7);
    nlopt_set_xtol_rel(search.get(), 1e-7);
    double least = 0;
    nlopt_optimize(search.get(), values.data(), &least);  // where it fails, the best so far stands in `values`
    if (searched.thrown) std::rethrow_exception(searched.thrown);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = in_bounds(task.unknowns[k], values[k]);
}

std::size_t worlds_for(const FitTask& task, const LeastSquaresOptions& options, const std::vector<double>& start) {
    if (options.worlds > 0) return options.worlds;
    const Scene scene = task.growth.scene(task.named(start));
    const bool is_random = std::any_of(scene.plants.begin(), scene.plants.end(),
                                       [](const Plant& plant) { return uses_random_numbers(*plant.model); });
    return std::max(task.worlds(), is_random ? usual_worlds : std::size_t{1});
}

}  // namespace

std::vector<double> FitResult::values() const {
    std::vector<double> values;
    for (const FittedParameter& parameter : parameters) values.push_back(parameter.value);
    return values;
}

std::string FitResult::in_words(const Inseparable& pair) const {
    return fmt::format("{} and {} cannot be told apart (correlation {:.3f}): fix one, or measure what only one changes",
                       parameters[pair.one].name, parameters[pair.other].name, pair.correlation);
}

FitResult fit_least_squares(const FitTask& task, const LeastSquaresOptions& options, const FitProgress& progress) {
    std::vector<double> values;
    for (const Unknown& unknown : task.unknowns) values.push_back(in_bounds(unknown, unknown.start));
    const bool is_bounded = std::all_of(task.unknowns.begin(), task.unknowns.end(), has_bounds);
    const std::size_t global = !is_bounded          ? 0
                               : options.search > 0 ? options.search
                                                    : comparisons_per_parameter * values.size();
    const std::size_t local = comparisons_per_parameter * values.size();
    Comparison comparison(task, worlds_for(task, options, values), global + 2 * local, progress);
    if (task.statistics().size() < values.size()) {
        throw UserError(fmt::format("{} measures cannot decide {} parameters: measure more, or fit fewer",
                                    task.statistics().size(), values.size()));
    }
    if (global > 0) {
        std::vector<double> found = values;
        search(NLOPT_GN_DIRECT_L, task, comparison, global, found);
        if (comparison.sum_of_squares(found) < comparison.sum_of_squares(values)) values = found;
        search(NLOPT_LN_SBPLX, task, comparison, local, values);
    }
    std::vector<FreeParameter> free;
    for (std::size_t k = 0; k < values.size(); ++k) {
        free.push_back({values[k], task.unknowns[k].lowest, task.unknowns[k].highest});
    }
    const LeastSquares best =
        analysis::fit_least_squares(free, [&](const std::vector<double>& at) { return comparison.residuals(at); });

    FitResult result;
    result.residual = best.residual;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double scale = std::max(std::abs(best.values[k]), std::abs(task.unknowns[k].start));
        const bool is_decided = best.errors[k] < 10 * scale;
        result.parameters.push_back(
            {task.unknowns[k].name, best.values[k], best.errors[k], std::nan(""), std::nan(""), is_decided});
        for (std::size_t other = 0; other < k; ++other) {
            const double correlation = best.correlations[k][other];
            if (std::abs(correlation) > hardly_told_apart) result.inseparable.push_back({other, k, correlation});
        }
    }
    const std::vector<Statistic> measured = task.statistics();
    const std::vector<double> residuals = comparison.residuals(best.values);
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double value = measured[i].value + residuals[i] * measured[i].scale;
        result.predictions.push_back({measured[i], value, value, value});
    }
    result.evaluations = comparison.worlds_grown();
    return result;
}

}  // namespace espalier::study
