// The charts of a fit.
#include "study/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::study {
namespace {

constexpr std::size_t points_of_density = 81, most_pairs = 6, most_statistics = 24, most_letters = 60;
constexpr std::size_t before = 0, after = 1;  // keys

/// Of a weighted sample, by normal kernels as wide as Silverman (1986, eq. 3.31) has them.
std::vector<double> density(const std::vector<double>& values, const std::vector<double>& weights,
                            const std::vector<double>& at) {
    const double quarter = weighted_quantile(values, weights, 0.25), half = weighted_quantile(values, weights, 0.75);
    double squares = 0;
    for (const double weight : weights) squares += weight * weight;
    const double width =
        std::max(0.9 * (half - quarter) / 1.34 * std::pow(squares, 0.2), 1e-12 * std::abs(half) + 1e-300);
    std::vector<double> densities;
    for (const double x : at) {
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double away = (x - values[i]) / width;
            sum += weights[i] * std::exp(-away * away / 2);
        }
        densities.push_back(sum / (width * std::sqrt(2 * std::numbers::pi)));
    }
    return densities;
}

/// The prior's density, from the slope of its distribution.
std::vector<double> density(const Prior& prior, const std::vector<double>& at) {
    const double step = 1e-4 * (prior.highest() - prior.lowest());
    std::vector<double> densities;
    for (const double x : at) {
        densities.push_back((prior.share_below(x + step) - prior.share_below(x - step)) / (2 * step));
    }
    return densities;
}

/// Evenly over the sample and as much again around it, within the prior.
std::vector<double> places_about(const std::vector<double>& values, const Prior& prior) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const double margin = (*greatest - *least) / 2;
    const double low = std::max(prior.lowest(), *least - margin), high = std::min(prior.highest(), *greatest + margin);
    std::vector<double> places;
    for (std::size_t i = 0; i < points_of_density; ++i) {
        places.push_back(low + static_cast<double>(i) / (points_of_density - 1) * (high - low));
    }
    return places;
}

void add_posterior(ChartPage& page, const FitTask& task, const Posterior& posterior) {
    const std::vector<std::vector<double>> columns = columns_of(task, posterior);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const Prior& prior = *task.unknowns[k].prior;
        const std::vector<double> at = places_about(columns[k], prior);
        Chart& chart = page.charts.emplace_back(Chart{task.unknowns[k].name, "density", {}});
        chart.series.push_back({before, at, density(prior, at)});
        chart.series.push_back({after, at, density(columns[k], posterior.weights, at)});
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
        for (std::size_t other = k + 1; other < columns.size(); ++other) {
            if (page.charts.size() >= columns.size() + most_pairs) return;
            Chart& chart = page.charts.emplace_back(Chart{task.unknowns[k].name, task.unknowns[other].name, {}});
            Series& dots = chart.series.emplace_back(Series{after, columns[k], columns[other]});
            dots.joined = false;
        }
    }
}

/// In the scales of the statistics: what was measured is 0.
void add_predictions(ChartPage& page, const std::vector<Prediction>& predictions) {
    if (predictions.size() > most_statistics) return;
    std::size_t letters = 0;
    for (const Prediction& one : predictions) letters += one.measured.name.size() + 2;
    const bool fits = letters <= most_letters;
    Chart chart{fits ? "" : "row of predictive.csv", "predicted - measured, in its scale", {}};
    Series line{after, {}, {}};
    for (const Prediction& one : predictions) {
        const auto away = [&](double value) { return (value - one.measured.value) / one.measured.scale; };
        line.x.push_back(static_cast<double>(chart.x_names.size()));
        line.y.push_back(away(one.middle));
        line.low.push_back(away(one.low));
        line.high.push_back(away(one.high));
        chart.x_names.push_back(fits ? one.measured.name : std::to_string(chart.x_names.size() + 1));
    }
    chart.series.push_back({before, line.x, std::vector<double>(line.x.size(), 0)});
    chart.series.push_back(std::move(line));
    page.charts.push_back(std::move(chart));
}

}  // namespace

ChartPage page_of(const FitTask& task, const FitResult& result, const std::string& title, bool dark) {
    ChartPage page;
    page.title = title;
    page.dark = dark;
    const bool has_posterior = result.posterior.has_value();
    page.keys = {{has_posterior ? "before" : "measured", 0, 1}, {has_posterior ? "after" : "fitted", 1, 0}};
    if (has_posterior) add_posterior(page, task, *result.posterior);
    add_predictions(page, result.predictions);
    return page;
}

}  // namespace espalier::study
