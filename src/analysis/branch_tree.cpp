#include "analysis/branch_tree.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace espalier::analysis {

std::int32_t BranchTree::add(std::int32_t parent, const glm::dvec3& base, const glm::dvec3& tip, double base_radius,
                             double radius, std::uint64_t module) {
    parents.push_back(parent);
    lengths.push_back(glm::distance(base, tip));
    base_radii.push_back(base_radius);
    radii.push_back(radius);
    bases.push_back(base);
    tips.push_back(tip);
    modules.push_back(module);
    return static_cast<std::int32_t>(parents.size() - 1);
}

Children::Children(const BranchTree& tree) : offsets(tree.size() + 2, 0), children(tree.size()) {
    for (const std::int32_t parent : tree.parents) ++offsets[static_cast<std::size_t>(parent + 2)];
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for (std::size_t i = 0; i < tree.size(); ++i) {
        children[next[static_cast<std::size_t>(tree.parents[i] + 1)]++] = static_cast<std::int32_t>(i);
    }
}

namespace {

/// Where an internode of the frame is in the tree of its plant: `inside`, the row it became or, if it has no length,
/// that of the one below; `below`, the row it stands on.
struct Footing {
    std::int32_t inside = BranchTree::ground;
    std::int32_t below = BranchTree::ground;
};

}  // namespace

std::vector<BranchTree> branch_trees(std::span<const FrameInternode> internodes, std::span<const std::uint32_t> plants,
                                     std::span<const double> uptakes) {
    std::unordered_map<std::uint32_t, std::size_t> tree_of;
    for (const std::uint32_t plant : plants) tree_of.emplace(plant, tree_of.size());
    std::vector<BranchTree> trees(tree_of.size());
    std::vector<Footing> places(internodes.size());
    for (std::size_t i = 0; i < internodes.size(); ++i) {
        const FrameInternode& internode = internodes[i];
        const auto known = tree_of.find(internode.plant);
        if (known == tree_of.end()) continue;
        if (!internode.bearer.is_none()) {
            const std::size_t bearer = internode.bearer.row();
            // An axis that begins where its bearer begins stands beside it.
            const bool beside = internode.base == internodes[bearer].base && internode.base != internodes[bearer].tip;
            places[i].below = beside ? places[bearer].below : places[bearer].inside;
        }
        places[i].inside = places[i].below;
        if (internode.base == internode.tip) continue;
        places[i].inside = trees[known->second].add(places[i].below, internode.base, internode.tip,
                                                    internode.base_radius, internode.tip_radius, internode.identity);
        if (!uptakes.empty()) trees[known->second].uptakes.push_back(uptakes[i]);
    }
    return trees;
}

double total_length(const BranchTree& tree) {
    return std::accumulate(tree.lengths.begin(), tree.lengths.end(), 0.0);
}

double total_surface(const BranchTree& tree) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const double slant = std::hypot(tree.lengths[i], tree.base_radii[i] - tree.radii[i]);
        sum += std::numbers::pi * (tree.base_radii[i] + tree.radii[i]) * slant;
    }
    return sum;
}

double total_volume(const BranchTree& tree) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const double r = tree.base_radii[i], s = tree.radii[i];
        sum += std::numbers::pi / 3 * tree.lengths[i] * (r * r + r * s + s * s);
    }
    return sum;
}

}  // namespace espalier::analysis
