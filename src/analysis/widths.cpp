#include "analysis/widths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace espalier::analysis {
namespace {

/// The logarithms of di / d0, fork after fork; all below 0.
struct Ratios {
    std::vector<double> logarithms;
    std::vector<std::size_t> offsets{0};

    std::size_t forks() const { return offsets.size() - 1; }
};

/// The n at which ln(sum of (di / d0)^n), added over forks [first, last), is 0. That sum falls with n and is convex, so
/// Newton's method climbs to its zero from n = 0, where it is positive, without ever passing it.
double exponent_of(const Ratios& ratios, std::size_t first, std::size_t last) {
    double n = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
        double value = 0, slope = 0;
        for (std::size_t fork = first; fork < last; ++fork) {
            const auto begin = ratios.logarithms.begin() + static_cast<std::ptrdiff_t>(ratios.offsets[fork]);
            const auto end = ratios.logarithms.begin() + static_cast<std::ptrdiff_t>(ratios.offsets[fork + 1]);
            const double greatest = *std::max_element(begin, end);  // taken out, so that exp stays in range
            double sum = 0, weighted = 0;
            for (auto logarithm = begin; logarithm != end; ++logarithm) {
                const double power = std::exp(n * (*logarithm - greatest));
                sum += power;
                weighted += power * *logarithm;
            }
            value += n * greatest + std::log(sum);
            slope += weighted / sum;
        }
        const double step = -value / slope;
        n += step;
        if (!(std::abs(step) > 1e-14 * n)) break;
    }
    return n;
}

/// The radius at the end of the module that begins with a branch: a smooth one is drawn in tapering pieces.
double radius_of(const BranchTree& tree, const Children& children, std::int32_t branch) {
    auto at = static_cast<std::size_t>(branch);
    while (tree.modules[at] != 0) {
        const auto next = children.of(static_cast<std::int32_t>(at));
        if (next.size() != 1 || tree.modules[static_cast<std::size_t>(next[0])] != tree.modules[at]) break;
        at = static_cast<std::size_t>(next[0]);
    }
    return tree.radii[at];
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

ForkWidths fork_widths(const BranchTree& tree) {
    ForkWidths widths;
    Ratios ratios;
    double area_ratios = 0;
    const Children children(tree);
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const auto branches = children.of(static_cast<std::int32_t>(i));
        const auto radius = [&](std::int32_t branch) { return radius_of(tree, children, branch); };
        if (branches.size() < 2 || !(tree.radii[i] > 0)) continue;
        if (!std::all_of(branches.begin(), branches.end(), [&](auto branch) { return radius(branch) > 0; })) continue;
        ++widths.forks;
        double areas = 0;
        bool all_thinner = true;
        for (const std::int32_t branch : branches) {
            const double ratio = radius(branch) / tree.radii[i];
            areas += ratio * ratio;
            all_thinner = all_thinner && ratio < 1;
        }
        area_ratios += areas;
        widths.largest_area_error = std::max(widths.largest_area_error, std::abs(areas - 1));
        if (!all_thinner) continue;
        for (const std::int32_t branch : branches)
            ratios.logarithms.push_back(std::log(radius(branch) / tree.radii[i]));
        ratios.offsets.push_back(ratios.logarithms.size());
    }
    widths.forks_with_exponent = ratios.forks();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    widths.area_ratio = widths.forks > 0 ? area_ratios / static_cast<double>(widths.forks) : nan;
    if (widths.forks == 0) widths.largest_area_error = nan;
    widths.exponent = widths.median_exponent = nan;
    if (ratios.forks() > 0) {
        widths.exponent = exponent_of(ratios, 0, ratios.forks());
        std::vector<double> exponents;
        for (std::size_t fork = 0; fork < ratios.forks(); ++fork) {
            exponents.push_back(exponent_of(ratios, fork, fork + 1));
        }
        widths.median_exponent = median_of(std::move(exponents));
    }
    return widths;
}

}  // namespace espalier::analysis
