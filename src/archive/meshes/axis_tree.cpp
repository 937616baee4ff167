#include "archive/meshes/axis_tree.h"

#include <glm/geometric.hpp>

#include <tuple>

namespace espalier::archive {
namespace {

using AxisIndex = AxisTree::AxisIndex;

glm::vec3 direction(const FrameInternode& internode) {
    const glm::vec3 along = internode.tip - internode.base;
    const float length = glm::length(along);
    return length > 0 ? along / length : glm::vec3(0);
}

/// The axis that goes on where another ends; none if all that begin there turn back.
AxisIndex continuation(const AxisTree& tree, const AxisTree::Axis& axis) {
    const FrameInternode& last = tree.internodes[axis.end.before()];
    AxisIndex best;
    std::tuple<float, float> most{0, 0};
    for (const AxisIndex borne : tree.axes_borne[axis.end.before()]) {
        const FrameInternode& first = tree.internodes[tree.axes[borne].first];
        const float straight = glm::dot(direction(last), direction(first));
        if (first.base != last.tip || straight <= 0) continue;
        const std::tuple rank{first.base_radius, straight};
        if (!best.is_none() && rank <= most) continue;
        best = borne;
        most = rank;
    }
    return best;
}

float thickness(const FrameInternode& internode) {
    return internode.tip_radius > 0 ? internode.tip_radius : internode.base_radius;
}

/// Across what the ring at the tip of an internode stands; 0: no branches leave there, or all turn back.
glm::vec3 fork_direction(const AxisTree& tree, const AxisTree::Axis& axis, InternodeIndex number) {
    const FrameInternode& bearer = tree.internodes[number];
    glm::vec3 sum(0);
    int branches = 0;
    const auto add = [&](const FrameInternode& branch) {
        const glm::vec3 along = direction(branch);
        if (branch.base != bearer.tip || glm::dot(direction(bearer), along) <= 0) return;
        sum += thickness(branch) * along;
        ++branches;
    };
    for (const AxisIndex borne : tree.axes_borne[number]) add(tree.internodes[tree.axes[borne].first]);
    if (branches > 0 && number.next() < axis.end) add(tree.internodes[number.next()]);
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

std::vector<AxisIndex> AxisTree::trunks() const {
    std::vector<AxisIndex> result;
    for (AxisIndex i(0); i < axes.next(); ++i) {
        if (axes[i].bearer.is_none()) result.push_back(i);
    }
    return result;
}

AxisTree axis_tree(const FrameGeometry& geometry, const MeshOptions& options) {
    AxisTree tree;
    const std::vector<FrameInternode> all = internodes_of(geometry);
    std::vector<InternodeIndex> number(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        FrameInternode internode = all[i];
        if (options.plant && internode.plant != *options.plant) continue;
        const InternodeIndex here = number[i] = tree.internodes.next();
        if (!internode.bearer.is_none()) internode.bearer = number[internode.bearer.row()];
        const bool begins = tree.axes.empty() || tree.internodes.back().axis != internode.axis;
        if (begins) {
            if (!internode.bearer.is_none()) tree.axes_borne[internode.bearer].push_back(tree.axes.next());
            tree.axes.push_back({internode.plant, here, here, internode.bearer});
        }
        tree.axes.back().end = here.next();
        tree.internodes.push_back(internode);
        tree.axes_borne.emplace_back();
    }
    return tree;
}

std::vector<AxisPath> axis_paths(const FrameGeometry& geometry, const MeshOptions& options) {
    const AxisTree tree = axis_tree(geometry, options);
    RowsOf<AxisTree::Axis, AxisIndex> next;
    RowsOf<AxisTree::Axis, bool> continues(tree.axes.size(), false);
    for (const AxisTree::Axis& axis : tree.axes) {
        next.push_back(continuation(tree, axis));
        if (!next.back().is_none()) continues[next.back()] = true;
    }
    RowsOf<FrameInternode, glm::vec3> forks(tree.internodes.size(), glm::vec3(0));
    for (const AxisTree::Axis& axis : tree.axes) {
        for (InternodeIndex k = axis.first; k < axis.end; ++k) forks[k] = fork_direction(tree, axis, k);
    }
    std::vector<AxisPath> paths;
    for (AxisIndex i(0); i < tree.axes.next(); ++i) {
        if (continues[i]) continue;
        const FrameInternode& first = tree.internodes[tree.axes[i].first];
        AxisPath& path = paths.emplace_back();
        path.plant = first.plant;
        path.row = geometry.lines.first + first.axis.row();
        path.stands_free = tree.axes[i].bearer.is_none();
        path.points.push_back(first.base_point);
        if (!path.stands_free) {
            const InternodeIndex number = tree.axes[i].bearer;
            const FrameInternode& bearer = tree.internodes[number];
            if (shares_ring(first, bearer, forks[number])) path.first_ring = bearer.tip_point;
        }
        for (AxisIndex at = i; !at.is_none(); at = next[at]) {
            const AxisTree::Axis& axis = tree.axes[at];
            for (InternodeIndex k = axis.first; k < axis.end; ++k) {
                path.points.push_back(tree.internodes[k].tip_point);
                if (forks[k] != glm::vec3(0)) path.forks.push_back({path.points.back(), forks[k]});
            }
        }
    }
    return paths;
}

}  // namespace espalier::archive
