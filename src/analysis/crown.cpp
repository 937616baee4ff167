#include "analysis/crown.h"

#include "espalier/geometry/plant_geometry.h"

#include "analysis/convex_hull.h"
#include "analysis/voxels.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>

namespace espalier::analysis {
namespace {

/// True for the internodes below the foot of a plant that rises above it.
std::vector<bool> roots_of(const BranchTree& tree) {
    std::vector<bool> is_root(tree.size(), false);
    const auto rises = [&](const glm::dvec3& tip) { return tip.y > tree.bases[0].y; };
    if (std::none_of(tree.tips.begin(), tree.tips.end(), rises)) return is_root;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const auto [low, high] = std::minmax(tree.bases[i].y, tree.tips[i].y);
        is_root[i] = high <= tree.bases[0].y && low < tree.bases[0].y;
    }
    return is_root;
}

/// True for the internodes above a fork of the shoot; for all, if there is neither a fork nor a leaf.
std::vector<bool> in_crown(const BranchTree& tree, const Children& children, const std::vector<bool>& is_root,
                           bool has_leaves) {
    std::vector<bool> inside(tree.size(), false);
    bool any = has_leaves;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (is_root[i]) continue;
        const std::int32_t parent = tree.parents[i];
        const bool below_is_inside = parent != BranchTree::ground && inside[static_cast<std::size_t>(parent)];
        const auto beside = children.of(parent);
        const auto shoots = std::count_if(beside.begin(), beside.end(), [&](std::int32_t child) {
            return !is_root[static_cast<std::size_t>(child)];
        });
        inside[i] = below_is_inside || shoots > 1;
        any = any || inside[i];
    }
    if (!any) inside.assign(tree.size(), true);
    return inside;
}

/// (places beyond the foot along an axis - places before it) / all.
double asymmetry(const std::vector<glm::dvec3>& places, const glm::dvec3& foot, int axis) {
    double sum = 0;
    for (const glm::dvec3& place : places) sum += (place[axis] > foot[axis]) - (place[axis] < foot[axis]);
    return places.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(places.size());
}

std::vector<glm::dvec3> ends_of(const BranchTree& tree, const Children& children, const std::vector<bool>& is_root,
                                const Leaves& leaves) {
    std::vector<glm::dvec3> ends;
    for (const Leaf& leaf : leaves.leaves) ends.push_back(leaf.position);
    if (!ends.empty()) return ends;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (!is_root[i] && children.of(static_cast<std::int32_t>(i)).empty()) ends.push_back(tree.tips[i]);
    }
    return ends;
}

}  // namespace

Crown measure_crown(const BranchTree& tree, const Leaves& leaves, double voxel) {
    const Children children(tree);
    const std::vector<bool> is_root = roots_of(tree);
    const std::vector<bool> inside = in_crown(tree, children, is_root, !leaves.leaves.empty());
    std::vector<glm::dvec3> points = leaves.corners;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (inside[i]) points.push_back(tree.bases[i]), points.push_back(tree.tips[i]);
    }
    Crown crown;
    if (points.empty()) {
        crown.asymmetry_x = crown.asymmetry_z = std::numeric_limits<double>::quiet_NaN();
        return crown;
    }
    const glm::dvec3 foot = tree.size() > 0 ? tree.bases[0] : points[0];
    Box box;
    std::vector<glm::dvec2> shadow;
    for (const glm::dvec3& point : points) {
        box.add(point);
        shadow.emplace_back(point.x, point.z);
    }
    const glm::dvec3 extents = box.upper - box.lower;
    crown.base = box.lower.y - foot.y;
    crown.top = box.upper.y - foot.y;
    crown.width_x = extents.x;
    crown.width_z = extents.z;
    crown.volume = convex_hull_volume(points);
    crown.projection = convex_hull_area(shadow);

    const double extent = std::max({extents.x, extents.y, extents.z});
    crown.voxel = voxel > 0 ? voxel : extent / 32;
    if (crown.voxel > 0) {
        VoxelSet voxels(box.lower, crown.voxel);
        for (const glm::dvec3& corner : leaves.corners) voxels.add_point(corner);
        for (std::size_t i = 0; i < tree.size(); ++i) {
            if (inside[i]) voxels.add_segment(tree.bases[i], tree.tips[i]);
        }
        crown.occupied = static_cast<double>(voxels.count()) * crown.voxel * crown.voxel * crown.voxel;
    }
    const std::vector<glm::dvec3> ends = ends_of(tree, children, is_root, leaves);
    crown.asymmetry_x = asymmetry(ends, foot, 0);
    crown.asymmetry_z = asymmetry(ends, foot, 2);
    return crown;
}

}  // namespace espalier::analysis
