#include "archive/meshes/axis_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
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

bool stands_beside(const FrameInternode& first, const FrameInternode& bearer) {
    return first.base == bearer.base && first.base != bearer.tip && first.order <= bearer.order;
}

/// The internode of an axis with the end that is nearest to a place.
InternodeIndex nearest_internode(const AxisTree& tree, const AxisTree::Axis& axis, const glm::vec3& place) {
    InternodeIndex nearest = axis.first;
    float least = glm::distance(tree.internodes[nearest].base, place);
    for (InternodeIndex i = axis.first; i < axis.end; ++i) {
        const float distance = glm::distance(tree.internodes[i].tip, place);
        if (distance < least) nearest = i, least = distance;
    }
    return nearest;
}

/// What stands on the very base of an axis is drawn before that: the first internode of the next axis of a lower order,
/// if it begins there, too.
InternodeIndex bearer_drawn_later(const AxisTree& tree, AxisIndex number) {
    const FrameInternode& first = tree.internodes[tree.axes[number].first];
    for (AxisIndex i = number.next(); i < tree.axes.next(); ++i) {
        const FrameInternode& other = tree.internodes[tree.axes[i].first];
        if (other.plant != first.plant) break;
        if (other.order < first.order) return other.base == first.base ? tree.axes[i].first : InternodeIndex();
    }
    return {};
}

/// Of the last axis of a lower order, the internode whose end is nearest; `last_of_order` are the axes before.
InternodeIndex linked_bearer(const AxisTree& tree, AxisIndex number, const std::vector<AxisIndex>& last_of_order) {
    const FrameInternode& first = tree.internodes[tree.axes[number].first];
    std::size_t order = std::min<std::size_t>(first.order, last_of_order.size());
    while (order > 0 && last_of_order[order - 1].is_none()) --order;
    return order > 0 ? nearest_internode(tree, tree.axes[last_of_order[order - 1]], first.base) : InternodeIndex();
}

/// The last internode of the axis that goes on behind a gap; none if this axis is another one. Measured plants draw the
/// first piece behind a gap with G (src/language/measured/drawing.cpp). In grown plants, too, there are no brackets
/// around axes of order 0; but stems beside each other may have that order by @Ax.
InternodeIndex before_gap(const AxisTree& tree, AxisIndex number, const std::vector<AxisIndex>& last_of_order) {
    const AxisTree::Axis& axis = tree.axes[number];
    const FrameInternode& first = tree.internodes[axis.first];
    if (first.order >= last_of_order.size() || last_of_order[first.order].is_none()) return {};
    const AxisTree::Axis& before = tree.axes[last_of_order[first.order]];
    const InternodeIndex last = before.end.before();
    const bool is_nearest = glm::distance(tree.internodes[last].tip, first.base) <
                            glm::distance(tree.internodes[before.first].base, first.base);
    return axis.is_unmarked || (first.order == 0 && is_nearest) ? last : InternodeIndex();
}

/// Whether an axis is another, or is borne by it, directly or not.
bool stands_on(const AxisTree& tree, const RowsOf<FrameInternode, AxisIndex>& axis_of, AxisIndex axis,
               AxisIndex other) {
    while (axis != other) {
        if (tree.axes[axis].bearer.is_none()) return false;
        axis = axis_of[tree.axes[axis].bearer];
    }
    return true;
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
            const std::vector<std::string>& symbols = geometry.symbol_names;  // the studio's pictures have none
            const bool is_unmarked = internode.symbol < symbols.size() && symbols[internode.symbol] == "G";
            tree.axes.push_back({internode.plant, here, here, internode.bearer, is_unmarked});
        }
        tree.axes.back().end = here.next();
        tree.internodes.push_back(internode);
        tree.axes_borne.emplace_back();
    }
    return tree;
}

void settle_bearers(AxisTree& tree) {
    RowsOf<FrameInternode, AxisIndex> axis_of;
    for (AxisIndex i(0); i < tree.axes.next(); ++i) {
        AxisTree::Axis& axis = tree.axes[i];
        const FrameInternode& first = tree.internodes[axis.first];
        while (!axis.bearer.is_none() && stands_beside(first, tree.internodes[axis.bearer])) {
            axis.bearer = tree.axes[axis_of[axis.bearer]].bearer;
        }
        for (InternodeIndex k = axis.first; k < axis.end; ++k) axis_of.push_back(i);
    }
    std::vector<AxisIndex> last_of_order;  // of the plant so far
    for (AxisIndex i(0); i < tree.axes.next(); ++i) {
        AxisTree::Axis& axis = tree.axes[i];
        const FrameInternode& first = tree.internodes[axis.first];
        if (i > AxisIndex(0) && tree.axes[i.before()].plant != axis.plant) last_of_order.clear();
        const auto hang_on = [&](InternodeIndex bearer) {
            if (!bearer.is_none() && !stands_on(tree, axis_of, axis_of[bearer], i)) axis.bearer = bearer;
        };
        if (axis.bearer.is_none()) hang_on(bearer_drawn_later(tree, i));
        if (axis.bearer.is_none()) {
            const InternodeIndex linked = linked_bearer(tree, i, last_of_order);
            const InternodeIndex last = before_gap(tree, i, last_of_order);
            hang_on(last.is_none() ? linked : last);
        }
        last_of_order.resize(first.order + std::size_t(1));
        last_of_order.back() = i;
    }
    for (InternodeIndex k(0); k < tree.internodes.next(); ++k) tree.axes_borne[k].clear();
    for (AxisIndex i(0); i < tree.axes.next(); ++i) {
        AxisTree::Axis& axis = tree.axes[i];
        if (axis.bearer.is_none()) continue;
        std::vector<AxisIndex>& borne = tree.axes_borne[axis.bearer];
        const bool is_at_end = axis.bearer.next() == tree.axes[axis_of[axis.bearer]].end;
        axis.goes_on =
            is_at_end && tree.internodes[axis.first].order == tree.internodes[axis.bearer].order &&
            std::none_of(borne.begin(), borne.end(), [&](AxisIndex each) { return tree.axes[each].goes_on; });
        borne.push_back(i);
    }
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
