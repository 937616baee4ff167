#include "environment/neighbours/point_grid.h"

#include "espalier/base/random.h"

#include <algorithm>
#include <numeric>

namespace espalier {

std::size_t PointGrid::Hash::operator()(const Cell& cell) const {
    const auto bits = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
    return mix(mix(bits(cell.x), bits(cell.y)), bits(cell.z));
}

PointGrid::PointGrid(std::span<const glm::dvec3> points, std::span<const std::uint32_t> members, double edge) {
    if (members.empty()) return;
    least_ = most_ = points[members[0]];
    for (const std::uint32_t member : members) {
        least_ = glm::min(least_, points[member]);
        most_ = glm::max(most_, points[member]);
    }
    const glm::dvec3 far = glm::max(glm::abs(least_), glm::abs(most_));
    edge_ = std::max(edge, 1e-14 * std::max({far.x, far.y, far.z}));
    if (!(edge_ > 0)) edge_ = 1;

    std::vector<Cell> cells(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) cells[i] = cell_of(points[members[i]]);
    std::vector<std::uint32_t> order(members.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return cells[a] < cells[b]; });

    members_.reserve(members.size());
    for (const std::uint32_t i : order) {
        if (cells_.empty() || cells_.back().cell != cells[i]) {
            by_cell_.emplace(cells[i], static_cast<std::uint32_t>(cells_.size()));
            const auto begin = static_cast<std::uint32_t>(members_.size());
            cells_.push_back({cells[i], begin, begin});
        }
        members_.push_back(members[i]);
        cells_.back().end = static_cast<std::uint32_t>(members_.size());
    }
}

}  // namespace espalier
