#include "analysis/branching.h"

#include "analysis/line_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::analysis {
namespace {

// Columns per fork have the ground in element 0 and the tip of internode i in element i + 1.
std::size_t fork_of(std::int32_t internode) {
    return static_cast<std::size_t>(internode + 1);
}

}  // namespace

StrahlerOrders strahler_orders(const BranchTree& tree) {
    StrahlerOrders result;
    result.orders.resize(tree.size());
    std::vector<std::uint8_t> highest(tree.size() + 1, 0), twice(tree.size() + 1, 0);
    const auto order_at = [&](std::size_t fork) { return static_cast<std::uint8_t>(highest[fork] + twice[fork]); };
    for (std::size_t i = tree.size(); i-- > 0;) {
        const std::uint8_t order = std::max<std::uint8_t>(order_at(i + 1), 1);
        result.orders[i] = order;
        const std::size_t below = fork_of(tree.parents[i]);
        if (order >= highest[below]) {
            twice[below] = order == highest[below];
            highest[below] = order;
        }
    }
    result.highest = order_at(0);
    return result;
}

RamificationMatrix ramification_matrix(const BranchTree& tree, const StrahlerOrders& orders) {
    const auto highest = static_cast<std::size_t>(std::max(orders.highest, 1));
    std::vector<std::vector<std::size_t>> counts;
    for (std::size_t order = 2; order <= highest; ++order) counts.emplace_back(order, 0);
    // How many branches of the highest order of its own a fork has been seen to have.
    std::vector<std::uint32_t> seen(tree.size() + 1, 0);
    const auto order_of = [&](std::size_t fork) {
        return fork == 0 ? static_cast<std::size_t>(orders.highest) : std::size_t{orders.orders[fork - 1]};
    };
    std::vector<std::uint8_t> carried(tree.size() + 1, 0);  // the fork has a branch of its own order
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const std::size_t below = fork_of(tree.parents[i]);
        if (orders.orders[i] == order_of(below)) carried[below] = 1;
    }
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const std::size_t below = fork_of(tree.parents[i]), order = order_of(below), branch = orders.orders[i];
        if (branch == order) continue;  // the fork's main branch
        const bool makes_order = !carried[below] && branch + 1 == order;
        if (makes_order && ++seen[below] == 1) continue;  // waits for the second of its order
        ++counts[order - 2][makes_order && seen[below] == 2 ? order - 1 : branch - 1];
    }
    RamificationMatrix matrix;
    for (const std::vector<std::size_t>& row : counts) {
        std::size_t sum = 0;
        for (const std::size_t count : row) sum += count;
        matrix.forks.push_back(sum);
        matrix.rows.emplace_back();
        for (const std::size_t count : row) {
            matrix.rows.back().push_back(static_cast<double>(count) / static_cast<double>(sum));
        }
    }
    return matrix;
}

std::vector<StreamOrder> streams(const BranchTree& tree, const StrahlerOrders& orders) {
    std::vector<StreamOrder> result(static_cast<std::size_t>(orders.highest));
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const std::int32_t parent = tree.parents[i];
        StreamOrder& of = result[orders.orders[i] - std::size_t{1}];
        const bool begins =
            parent == BranchTree::ground || orders.orders[static_cast<std::size_t>(parent)] != orders.orders[i];
        of.streams += begins;
        ++of.internodes;
        of.mean_length += tree.lengths[i];
        of.mean_diameter += 2 * tree.radii[i] * tree.lengths[i];
    }
    // Two orders that meet on the ground itself make an order without internodes.
    std::erase_if(result, [](const StreamOrder& order) { return order.streams == 0; });
    for (StreamOrder& of : result) {
        of.mean_diameter /= of.mean_length;
        of.mean_length /= static_cast<double>(of.streams);
    }
    return result;
}

HortonRatios horton_ratios(const std::vector<StreamOrder>& streams) {
    std::vector<double> order, number, length, diameter;
    for (const StreamOrder& of : streams) {
        order.push_back(static_cast<double>(order.size()));
        number.push_back(std::log(static_cast<double>(of.streams)));
        length.push_back(std::log(of.mean_length));
        diameter.push_back(std::log(of.mean_diameter));
    }
    const auto factor = [&](const std::vector<double>& logarithms) {
        const double slope = fit_line(order, logarithms).slope;
        return std::isfinite(slope) ? std::exp(slope) : std::numeric_limits<double>::quiet_NaN();
    };
    return {1 / factor(number), factor(length), factor(diameter)};
}

BranchingCounts count_branching(const BranchTree& tree) {
    BranchingCounts counts;
    std::vector<std::uint32_t> branches(tree.size() + 1, 0), forks_below(tree.size() + 1, 0);
    std::vector<double> path(tree.size() + 1, 0);
    for (const std::int32_t parent : tree.parents) ++branches[fork_of(parent)];
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const std::size_t below = fork_of(tree.parents[i]);
        forks_below[i + 1] = forks_below[below] + (branches[below] > 1);
        path[i + 1] = path[below] + tree.lengths[i];
        counts.tips += branches[i + 1] == 0;
        counts.depth = std::max<std::size_t>(counts.depth, forks_below[i + 1]);
        counts.longest_path = std::max(counts.longest_path, path[i + 1]);
    }
    counts.forks = static_cast<std::size_t>(
        std::count_if(branches.begin(), branches.end(), [](std::uint32_t number) { return number > 1; }));
    return counts;
}

}  // namespace espalier::analysis
