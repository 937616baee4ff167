#include "environment/space/neighbours/point_grid.h"

#include "espalier/base/stop.h"

#include <bit>

namespace espalier::environment {

PointGrid::PointGrid(std::span<const glm::dvec3> points, std::span<const std::uint32_t> members, double edge) {
    if (members.empty()) return;
    least_ = most_ = points[members[0]];
    for (const std::uint32_t member : members) {
        least_ = glm::min(least_, points[member]);
        most_ = glm::max(most_, points[member]);
    }
    const glm::dvec3 far = glm::max(glm::abs(least_), glm::abs(most_));
    edge = std::max(edge, 1e-14 * std::max({far.x, far.y, far.z}));
    per_edge_ = edge > 0 ? 1 / edge : 1;

    const std::size_t slots = std::bit_ceil(2 * members.size() + 2);
    shift_ = 64 - std::countr_zero(slots);
    table_.assign(slots, none);
    std::vector<std::uint32_t> cell_of_member(members.size()), counts;
    cells_.reserve(members.size());
    counts.reserve(members.size());
    StopCheck<4096> check;
    for (std::size_t i = 0; i < members.size(); ++i) {
        check();
        const Cell cell = cell_of(points[members[i]]);
        std::uint32_t& number = table_[slot_of(cell)];
        if (number == none) {
            number = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back(cell);
            counts.push_back(0);
        }
        ++counts[cell_of_member[i] = number];
    }
    ends_.assign(1, 0);
    for (const std::uint32_t count : counts) ends_.push_back(ends_.back() + count);
    members_.resize(members.size());
    std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
    for (std::size_t i = 0; i < members.size(); ++i) {
        check();
        members_[next[cell_of_member[i]]++] = members[i];
    }
}

}  // namespace espalier::environment
