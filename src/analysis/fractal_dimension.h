// The fractal dimension of a skeleton by counting boxes.
#pragma once

#include "analysis/branch_tree.h"

#include <cstddef>
#include <vector>

namespace espalier::analysis {

/// N(s) boxes of edge s are touched, N ~ s^-dimension over the scales from `largest_box` down to `smallest_box`:
/// a quarter of the skeleton's largest extent, halved at least three times and at most eight, as long as a box is no
/// smaller than the mean internode (below, a skeleton is a bundle of lines). `error` is the standard error of the fit.
struct FractalDimension {
    double dimension = 0, error = 0;
    double smallest_box = 0, largest_box = 0;  ///< m
    std::vector<std::size_t> counts;           ///< from the smallest box to the largest
};
/// NaN for a plant without internodes.
FractalDimension fractal_dimension(const BranchTree& tree);

}  // namespace espalier::analysis
