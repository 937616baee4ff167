#include "language/measured/nearest_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace espalier::language::measured {
namespace {

double square_of(const glm::dvec3& v) {
    return glm::dot(v, v);
}

}  // namespace

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

}  // namespace espalier::language::measured
