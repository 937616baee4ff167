// Trees whose measures are known, made internode by internode.
#pragma once

#include "analysis/branch_tree.h"

#include <cmath>
#include <random>
#include <vector>

namespace espalier {

using namespace espalier::analysis;

/// Internodes one upon the other, each of length 1 and radius 1.
inline BranchTree chain(std::size_t count) {
    BranchTree tree;
    for (std::size_t i = 0; i < count; ++i) {
        const auto y = static_cast<double>(i);
        tree.add(static_cast<std::int32_t>(i) - 1, {0, y, 0}, {0, y + 1, 0}, 1, 1);
    }
    return tree;
}

/// A chain with a leaf at every node.
inline BranchTree caterpillar(std::size_t count) {
    BranchTree tree = chain(count);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const glm::dvec3 node = tree.tips[i];
        tree.add(static_cast<std::int32_t>(i), node, node + glm::dvec3(0.5, 0, 0), 0.1, 0.1);
    }
    return tree;
}

/// One internode with `depth` generations of forks on it, every branch `length_ratio` times as long and `width_ratio`
/// times as wide as what bears it; it turns by 45 degrees in a plane.
inline BranchTree binary_tree(int depth, double length_ratio = 1, double width_ratio = 1) {
    BranchTree tree;
    std::vector<double> angles{0};
    tree.add(BranchTree::ground, {0, 0, 0}, {0, 1, 0}, 1, 1);
    for (std::size_t i = 0, generation = 1; generation < std::size_t{1} << depth; ++i) {
        generation = i + 2;
        for (const double side : {-1, 1}) {
            const double length = tree.lengths[i] * length_ratio, width = tree.radii[i] * width_ratio;
            const double angle = angles[i] + side * std::atan(1.0);
            angles.push_back(angle);
            const glm::dvec3 tip = tree.tips[i] + length * glm::dvec3(std::sin(angle), std::cos(angle), 0);
            tree.add(static_cast<std::int32_t>(i), tree.tips[i], tip, width, width);
        }
    }
    return tree;
}

/// A random binary tree, all shapes with so many forks equally likely (Remy 1985), as parents: element i has a parent
/// before it.
inline BranchTree random_binary_tree(std::size_t forks, unsigned seed) {
    struct Node {
        std::int64_t parent = -1, left = -1, right = -1;
    };
    std::mt19937_64 random(seed);
    std::vector<Node> nodes(1);
    for (std::size_t fork = 0; fork < forks; ++fork) {
        const auto at = static_cast<std::int64_t>(random() % nodes.size());
        const auto inner = static_cast<std::int64_t>(nodes.size()), leaf = inner + 1;
        const bool left = random() % 2 == 0;
        const std::int64_t parent = nodes[static_cast<std::size_t>(at)].parent;
        nodes.push_back({parent, left ? leaf : at, left ? at : leaf});
        nodes.push_back({inner, -1, -1});
        nodes[static_cast<std::size_t>(at)].parent = inner;
        if (parent >= 0) {
            Node& above = nodes[static_cast<std::size_t>(parent)];
            (above.left == at ? above.left : above.right) = inner;
        }
    }
    std::int64_t root = 0;
    while (nodes[static_cast<std::size_t>(root)].parent >= 0) root = nodes[static_cast<std::size_t>(root)].parent;
    BranchTree tree;
    std::vector<std::pair<std::int64_t, std::int32_t>> open{{root, BranchTree::ground}};
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        const std::int32_t row = tree.add(parent, {0, 0, 0}, {0, 1, 0}, 1, 1);
        const Node& of = nodes[static_cast<std::size_t>(node)];
        if (of.left >= 0) open.insert(open.end(), {{of.left, row}, {of.right, row}});
    }
    return tree;
}

}  // namespace espalier
