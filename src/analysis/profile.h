// How a plant is spread over heights and depths, and its internodes over lengths.
#pragma once

#include "analysis/branch_tree.h"
#include "analysis/leaves.h"

#include <cstddef>
#include <vector>

namespace espalier::analysis {

/// What lies between two heights of the world, m: those of the soil, whatever height the plant stands at.
struct Layer {
    double from = 0, to = 0;
    double length = 0;          ///< length of the internodes' pieces in it, m
    double surface = 0;         ///< surface of these pieces, m2
    double leaf_area = 0;       ///< area of the leaves whose middle is in it, m2
    double uptake = 0;          ///< water that its roots take up, cm3/d; NaN where that was not recorded
    double density = 0;         ///< length per volume: of the layer's thickness times the area below, m/m3 = m-2
    double ground_density = 0;  ///< the same, over an area of ground that is given; NaN if none is
};

/// Layers of one thickness from the lowest to the highest that holds anything; their bounds are multiples of it. The
/// area is that of the plant's shadow from straight above. `thickness` 0: the least of 1, 2 or 5 times a power of ten
/// that makes no more than 20. Throws UserError if one is given that makes more than 100,000.
std::vector<Layer> layers(const BranchTree& tree, const Leaves& leaves, double thickness = 0);

/// The area of the plant's shadow from straight above, m2.
double shadow_of(const BranchTree& tree);

/// 1, 2 or 5 times a power of ten, so that some 20 layers make `extent`.
double convenient_thickness(double extent);
/// A thickness of which the convenient one for this plant, and those for greater extents, are multiples.
double part_of_thickness(const BranchTree& tree, const Leaves& leaves);

/// Layers of `thickness` over [low, high] at least, from layers of a part of it. Densities are those of the areas
/// given; NaN for areas that are not above 0.
std::vector<Layer> merged_layers(const std::vector<Layer>& parts, double thickness, double low, double high,
                                 double shadow, double ground);

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
