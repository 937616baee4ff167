// How a plant is spread over heights and depths, and its internodes over lengths.
#pragma once

#include "analysis/branch_tree.h"
#include "analysis/leaves.h"

#include <cstddef>
#include <vector>

namespace espalier::analysis {

/// What lies between two heights above the plant's foot (negative: depths), m.
struct Layer {
    double from = 0, to = 0;
    double length = 0;     ///< of the internodes' pieces in it, m
    double surface = 0;    ///< of these, m2
    double leaf_area = 0;  ///< of the leaves whose middle is in it, m2
    double density = 0;    ///< length per volume: of the layer's thickness times the area below, m/m3 = m-2
};

/// Layers of one thickness from the lowest to the highest that holds anything; their bounds are multiples of it. The
/// area is that of the plant's shadow from straight above. `thickness` 0: the least of 1, 2 or 5 times a power of ten
/// that makes no more than 20. Throws UserError if one is given that makes more than 100,000.
std::vector<Layer> layers(const BranchTree& tree, const Leaves& leaves, double thickness = 0);

/// Internodes with from <= length < to; 16 bins from 0, the last one closed.
struct LengthBin {
    double from = 0, to = 0;
    std::size_t internodes = 0;
};
struct LengthDistribution {
    double least = 0, median = 0, greatest = 0, mean = 0, deviation = 0;  ///< m; NaN without internodes
    std::vector<LengthBin> bins;
};
LengthDistribution length_distribution(const BranchTree& tree);

}  // namespace espalier::analysis
