#include "archive/meshes/axis_tree.h"

#include <glm/geometric.hpp>

#include <tuple>

namespace espalier::archive {
namespace {

glm::vec3 direction(const FrameInternode& internode) {
    const glm::vec3 along = internode.tip - internode.base;
    const float length = glm::length(along);
    return length > 0 ? along / length : glm::vec3(0);
}

/// The axis that goes on where another ends; none if all that begin there turn back.
std::int32_t continuation(const AxisTree& tree, const AxisTree::Axis& axis) {
    const FrameInternode& last = tree.internodes[axis.end - 1];
    std::int32_t best = FrameInternode::none;
    std::tuple<float, float> most{0, 0};
    for (const std::uint32_t borne : tree.axes_borne[axis.end - 1]) {
        const FrameInternode& first = tree.internodes[tree.axes[borne].first];
        const float straight = glm::dot(direction(last), direction(first));
        if (first.base != last.tip || straight <= 0) continue;
        const std::tuple rank{first.base_radius, straight};
        if (best >= 0 && rank <= most) continue;
        best = static_cast<std::int32_t>(borne);
        most = rank;
    }
    return best;
}

float thickness(const FrameInternode& internode) {
    return internode.tip_radius > 0 ? internode.tip_radius : internode.base_radius;
}

/// Across what the ring at the tip of an internode stands; 0: no branches leave there, or all turn back.
glm::vec3 fork_direction(const AxisTree& tree, const AxisTree::Axis& axis, std::uint32_t number) {
    const FrameInternode& bearer = tree.internodes[number];
    glm::vec3 sum(0);
    int branches = 0;
    const auto add = [&](const FrameInternode& branch) {
        const glm::vec3 along = direction(branch);
        if (branch.base != bearer.tip || glm::dot(direction(bearer), along) <= 0) return;
        sum += thickness(branch) * along;
        ++branches;
    };
    for (const std::uint32_t borne : tree.axes_borne[number]) add(tree.internodes[tree.axes[borne].first]);
    if (branches > 0 && number + 1 < axis.end) add(tree.internodes[number + 1]);
    const float length = glm::length(sum);
    return branches > 1 && length > 0 ? sum / length : glm::vec3(0);
}

/// Branches that are much thinner than the ring, or stand across it, begin with rings of their own.
bool shares_ring(const FrameInternode& branch, const FrameInternode& bearer, const glm::vec3& ring) {
    constexpr float least_thickness = 0.5f, least_cosine = 0.5f;
    return branch.base == bearer.tip && thickness(branch) >= least_thickness * bearer.tip_radius &&
           glm::dot(direction(branch), ring) >= least_cosine;
}

}  // namespace

std::vector<std::uint32_t> AxisTree::trunks() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < axes.size(); ++i) {
        if (axes[i].bearer == FrameInternode::none) result.push_back(i);
    }
    return result;
}

AxisTree axis_tree(const FrameGeometry& geometry, const MeshOptions& options) {
    AxisTree tree;
    std::vector<std::int32_t> number(geometry.lines.connectivity.size(), FrameInternode::none);
    const std::vector<FrameInternode> all = internodes_of(geometry);
    for (std::size_t i = 0; i < all.size(); ++i) {
        FrameInternode internode = all[i];
        if (options.plant && internode.plant != *options.plant) continue;
        const auto here = static_cast<std::uint32_t>(tree.internodes.size());
        number[i] = static_cast<std::int32_t>(here);
        if (internode.bearer >= 0) internode.bearer = number[static_cast<std::size_t>(internode.bearer)];
        const bool begins = tree.axes.empty() || tree.internodes.back().axis != internode.axis;
        if (begins) {
            tree.axes.push_back({internode.plant, here, here, internode.bearer});
            if (internode.bearer >= 0) {
                tree.axes_borne[static_cast<std::size_t>(internode.bearer)].push_back(
                    static_cast<std::uint32_t>(tree.axes.size() - 1));
            }
        }
        tree.axes.back().end = here + 1;
        tree.internodes.push_back(internode);
        tree.axes_borne.emplace_back();
    }
    return tree;
}

std::vector<AxisPath> axis_paths(const FrameGeometry& geometry, const MeshOptions& options) {
    const AxisTree tree = axis_tree(geometry, options);
    std::vector<std::int32_t> next;
    std::vector<bool> continues(tree.axes.size(), false);
    for (const AxisTree::Axis& axis : tree.axes) {
        next.push_back(continuation(tree, axis));
        if (next.back() >= 0) continues[static_cast<std::size_t>(next.back())] = true;
    }
    std::vector<glm::vec3> forks(tree.internodes.size(), glm::vec3(0));
    for (const AxisTree::Axis& axis : tree.axes) {
        for (std::uint32_t k = axis.first; k < axis.end; ++k) forks[k] = fork_direction(tree, axis, k);
    }
    std::vector<AxisPath> paths;
    for (std::size_t i = 0; i < tree.axes.size(); ++i) {
        if (continues[i]) continue;
        const FrameInternode& first = tree.internodes[tree.axes[i].first];
        AxisPath& path = paths.emplace_back();
        path.plant = first.plant;
        path.row = geometry.lines.first + first.axis;
        path.stands_free = tree.axes[i].bearer == FrameInternode::none;
        path.points.push_back(first.base_point);
        if (!path.stands_free) {
            const auto number = static_cast<std::size_t>(tree.axes[i].bearer);
            const FrameInternode& bearer = tree.internodes[number];
            if (shares_ring(first, bearer, forks[number])) path.first_ring = bearer.tip_point;
        }
        for (auto at = static_cast<std::int32_t>(i); at >= 0; at = next[static_cast<std::size_t>(at)]) {
            const AxisTree::Axis& axis = tree.axes[static_cast<std::size_t>(at)];
            for (std::uint32_t k = axis.first; k < axis.end; ++k) {
                path.points.push_back(tree.internodes[k].tip_point);
                if (forks[k] != glm::vec3(0)) path.forks.push_back({path.points.back(), forks[k]});
            }
        }
    }
    return paths;
}

}  // namespace espalier::archive
