// How a tree branches: Strahler orders, the ramification matrix, Horton's ratios. Linear in the number of internodes.
#pragma once

#include "analysis/branch_tree.h"

#include <cstdint>
#include <vector>

namespace espalier::analysis {

/// Strahler 1957: 1 at a tip; where branches meet the highest order of theirs, one more if two have it.
struct StrahlerOrders {
    std::vector<std::uint8_t> orders;  ///< order of each internode
    int highest = 0;  ///< order of the plant, where all that stands on the ground meets; 0: no internodes
};
StrahlerOrders strahler_orders(const BranchTree& tree);

/// Viennot, Eyrolles, Janey & Arques 1989. A fork of order k has bi-order (k, j), j < k, or (k - 1, k - 1). Row k - 2
/// of the matrix shows the forks of order k: column j - 1 the part of those with (k, j), the last, column k - 1, that
/// of those with (k - 1, k - 1). A fork of more than two branches counts as forks of two, the highest orders first.
struct RamificationMatrix {
    std::vector<std::vector<double>> rows;  ///< each sums to 1
    std::vector<std::size_t> forks;         ///< number of forks that each row counts; every row has some
};
RamificationMatrix ramification_matrix(const BranchTree& tree, const StrahlerOrders& orders);

/// The streams of one Strahler order: chains of internodes of that order.
struct StreamOrder {
    std::size_t streams = 0, internodes = 0;
    double mean_length = 0;    ///< mean length of the streams, m
    double mean_diameter = 0;  ///< mean diameter along the streams, m
};
/// Element k - 1 describes order k.
std::vector<StreamOrder> streams(const BranchTree& tree, const StrahlerOrders& orders);

/// Horton 1945: the factors from order to order by which streams grow fewer, longer and thicker, fitted through all
/// orders. NaN with fewer than two orders, or where a width is 0.
struct HortonRatios {
    double branching, length, diameter;
};
HortonRatios horton_ratios(const std::vector<StreamOrder>& streams);

struct BranchingCounts {
    std::size_t tips = 0, forks = 0;
    std::size_t depth = 0;    ///< most forks between the ground and a tip
    double longest_path = 0;  ///< from the ground to a tip, m
};
BranchingCounts count_branching(const BranchTree& tree);

}  // namespace espalier::analysis
