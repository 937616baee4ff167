// How widths go together at forks: the pipe model's exponent, Leonardo da Vinci's rule.
#pragma once

#include "analysis/branch_tree.h"

namespace espalier::analysis {

/// d0 is the diameter at an internode's tip, di those at the tips of the internodes on it. Forks with a width of 0 are
/// left out. NaN where no fork tells.
struct ForkWidths {
    std::size_t forks = 0;  ///< with widths
    /// d0^n = sum di^n (Shinozaki et al. 1964; Murray 1926): the n at which this holds for the forks on the geometric
    /// mean, and the median of their own n. A fork has an n if every branch is thinner than what bears it.
    double exponent = 0, median_exponent = 0;
    std::size_t forks_with_exponent = 0;
    /// d0^2 = sum di^2 (Leonardo): sum di^2 / d0^2 on the arithmetic mean, and the largest distance from 1.
    double area_ratio = 0, largest_area_error = 0;
};
ForkWidths fork_widths(const BranchTree& tree);

}  // namespace espalier::analysis
