#include "language/measured/joining.h"

#include "espalier/base/map_origin.h"
#include "espalier/language/measured_plants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace espalier::language::measured {
namespace {

class NearestPoint {
public:
    struct Spot {
        std::size_t segment = 0;  ///< from this node to the next
        double share = 0;         ///< of the segment, 0 to 1
        double square = 0;        ///< of the distance
    };

    /// Keeps a reference to the nodes, of which there is one at least.
    explicit NearestPoint(const std::vector<MeasuredNode>& nodes);
    /// The first of the nearest ones.
    Spot to(const glm::dvec3& place) const;

    /// On one segment; the last node is a segment of its own.
    static Spot on_segment(const std::vector<MeasuredNode>& nodes, std::size_t segment, const glm::dvec3& place);

private:
    struct Box {
        glm::dvec3 lower, upper;
    };
    static constexpr std::size_t width = 8;  ///< of a box, in boxes of the level below or in segments

    void search(std::size_t level, std::size_t box, const glm::dvec3& place, Spot& best) const;

    const std::vector<MeasuredNode>& nodes_;
    std::vector<std::vector<Box>> levels_;  ///< of segments first; the last is one box
};

double square_of(const glm::dvec3& v) {
    return glm::dot(v, v);
}

NearestPoint::NearestPoint(const std::vector<MeasuredNode>& nodes) : nodes_(nodes) {
    std::vector<Box> below;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const glm::dvec3 next = nodes[std::min(i + 1, nodes.size() - 1)].at;
        below.push_back({glm::min(nodes[i].at, next), glm::max(nodes[i].at, next)});
    }
    while (levels_.empty() || below.size() > 1) {
        std::vector<Box>& level = levels_.emplace_back();
        for (std::size_t i = 0; i < below.size(); ++i) {
            if (i % width == 0) {
                level.push_back(below[i]);
                continue;
            }
            level.back().lower = glm::min(level.back().lower, below[i].lower);
            level.back().upper = glm::max(level.back().upper, below[i].upper);
        }
        below = level;
    }
}

NearestPoint::Spot NearestPoint::on_segment(const std::vector<MeasuredNode>& nodes, std::size_t segment,
                                            const glm::dvec3& place) {
    const glm::dvec3& begin = nodes[segment].at;
    const glm::dvec3 along = nodes[std::min(segment + 1, nodes.size() - 1)].at - begin;
    const double square = square_of(along);
    const double share = square > 0 ? std::clamp(glm::dot(place - begin, along) / square, 0.0, 1.0) : 0.0;
    return {segment, share, square_of(place - begin - share * along)};
}

NearestPoint::Spot NearestPoint::to(const glm::dvec3& place) const {
    Spot best{0, 0, std::numeric_limits<double>::infinity()};
    search(levels_.size() - 1, 0, place, best);
    return best;
}

void NearestPoint::search(std::size_t level, std::size_t box, const glm::dvec3& place, Spot& best) const {
    const Box& around = levels_[level][box];
    const glm::dvec3 beyond = place - glm::clamp(place, around.lower, around.upper);
    if (square_of(beyond) >= best.square) return;
    const std::size_t parts = level == 0 ? nodes_.size() : levels_[level - 1].size();
    for (std::size_t part = box * width; part < std::min(box * width + width, parts); ++part) {
        if (level > 0) {
            search(level - 1, part, place, best);
            continue;
        }
        const Spot spot = on_segment(nodes_, part, place);
        if (spot.square < best.square) best = spot;
    }
}

/// Where an axis stands on its bearer.
struct Stand {
    std::size_t axis, segment;
    double share;
};

std::array<glm::dvec3, 2> extent_of(const std::vector<LooseAxis>& axes) {
    glm::dvec3 lower(INFINITY), upper(-INFINITY);
    for (const LooseAxis& axis : axes) {
        for (const MeasuredNode& node : axis.nodes) {
            lower = glm::min(lower, node.at);
            upper = glm::max(upper, node.at);
        }
    }
    return {lower, upper};
}

void subtract(MapOrigin& origin, std::vector<LooseAxis>& axes) {
    const auto [lower, upper] = extent_of(axes);
    if (!(lower.x <= upper.x)) return;
    const glm::dvec3 subtracted = origin.of(lower, upper, Place{axes.front().place.file, 1, 1});
    for (LooseAxis& axis : axes) {
        for (MeasuredNode& node : axis.nodes) node.at = MapOrigin::shifted(node.at, subtracted);
        for (MeasuredOrgan& organ : axis.organs) organ.place[3] = MapOrigin::shifted(organ.place[3], subtracted);
    }
}

class Joiner {
public:
    explicit Joiner(std::vector<LooseAxis> axes) : axes_(std::move(axes)), borne_(axes_.size()) {
        pass_over_empty();
        tolerance_ = 1e-6 * extent();
    }

    std::vector<MeasuredAxis> joined() {
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            if (!axes_[i].nodes.empty() && axes_[i].bearer) borne_[*axes_[i].bearer].push_back(i);
        }
        on_node_.resize(axes_.size(), 0);
        for (std::size_t i = 0; i < axes_.size(); ++i) place_borne(i);
        return sorted();
    }

private:
    /// What an axis without nodes bears is borne by its bearer.
    void pass_over_empty() {
        for (LooseAxis& axis : axes_) {
            while (axis.bearer && axes_[*axis.bearer].nodes.empty()) {
                axis.bearer = axes_[*axis.bearer].bearer;
                axis.on_node.reset();
            }
        }
    }

    double extent() const {
        const auto [lower, upper] = extent_of(axes_);
        return lower.x <= upper.x ? glm::length(upper - lower) : 0;
    }

    void place_borne(std::size_t bearer) {
        if (borne_[bearer].empty()) return;
        const std::vector<MeasuredNode>& line = axes_[bearer].nodes;
        const NearestPoint nearest(line);
        std::vector<Stand> stands;
        for (const std::size_t axis : borne_[bearer]) stands.push_back(stand_of(axis, line, nearest));
        std::stable_sort(stands.begin(), stands.end(), [](const Stand& a, const Stand& b) {
            return a.segment != b.segment ? a.segment < b.segment : a.share < b.share;
        });
        divide(bearer, stands);
    }

    Stand stand_of(std::size_t axis, const std::vector<MeasuredNode>& line, const NearestPoint& nearest) const {
        const glm::dvec3& base = axes_[axis].nodes[0].at;
        const std::optional<std::size_t> node = axes_[axis].on_node;
        const bool says_node = node && *node < line.size();
        if (says_node && glm::distance(base, line[*node].at) <= tolerance_) return {axis, *node, 0};
        const NearestPoint::Spot spot = nearest.to(base);
        if (says_node && spot.square > tolerance_ * tolerance_) return {axis, *node, 0};
        const double length =
            spot.segment + 1 < line.size() ? glm::distance(line[spot.segment].at, line[spot.segment + 1].at) : 0;
        if (spot.share * length <= tolerance_) return {axis, spot.segment, 0};
        if ((1 - spot.share) * length <= tolerance_) return {axis, spot.segment + 1, 0};
        return {axis, spot.segment, spot.share};
    }

    /// A node for each place, in their order, where there is none yet.
    void divide(std::size_t bearer, const std::vector<Stand>& stands) {
        const std::vector<MeasuredNode>& line = axes_[bearer].nodes;
        std::vector<MeasuredNode> nodes;
        nodes.reserve(line.size() + stands.size());
        auto stand = stands.begin();
        std::vector<std::size_t> place;  // of the nodes that were there
        for (std::size_t i = 0; i < line.size(); ++i) {
            place.push_back(nodes.size());
            nodes.push_back(line[i]);
            double last = 0;
            for (; stand != stands.end() && stand->segment == i; ++stand) {
                if (stand->share > last) nodes.push_back(between(line[i], line[i + 1], last = stand->share));
                on_node_[stand->axis] = nodes.size() - 1;
            }
        }
        for (MeasuredOrgan& organ : axes_[bearer].organs) organ.on_node = place[organ.on_node];
        axes_[bearer].nodes = std::move(nodes);
    }

    static MeasuredNode between(const MeasuredNode& a, const MeasuredNode& b, double share) {
        const auto mixed = [share](const auto& from, const auto& to) { return from + share * (to - from); };
        return {mixed(a.at, b.at), mixed(a.diameter, b.diameter), mixed(a.day, b.day), b.linked};
    }

    std::vector<MeasuredAxis> sorted() {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            if (!axes_[i].nodes.empty()) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return axes_[a].plant < axes_[b].plant; });
        std::vector<std::size_t> place(axes_.size());
        std::vector<MeasuredAxis> sorted;
        for (const std::size_t i : order) {
            place[i] = sorted.size();
            LooseAxis& axis = axes_[i];
            MeasuredAxis& out = sorted.emplace_back();
            out.label = std::move(axis.label);
            out.plant = axis.plant;
            if (axis.bearer) out.bearer = place[*axis.bearer];
            out.on_node = on_node_[i];
            out.order = out.bearer ? sorted[*out.bearer].order + 1 : 0;
            out.nodes = std::move(axis.nodes);
            out.organs = std::move(axis.organs);
            std::stable_sort(out.organs.begin(), out.organs.end(),
                             [](const MeasuredOrgan& a, const MeasuredOrgan& b) { return a.on_node < b.on_node; });
            out.place = std::move(axis.place);
        }
        return sorted;
    }

    std::vector<LooseAxis> axes_;
    std::vector<std::vector<std::size_t>> borne_;
    std::vector<std::size_t> on_node_;
    double tolerance_ = 0;
};

}  // namespace

std::vector<MeasuredAxis> joined(std::vector<LooseAxis> axes) {
    if (MapOrigin* const origin = MapOrigin::current()) subtract(*origin, axes);
    return Joiner(std::move(axes)).joined();
}

}  // namespace espalier::language::measured
