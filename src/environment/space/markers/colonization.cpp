#include "environment/space/markers/colonization.h"

#include "espalier/base/math.h"
#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "environment/space/neighbours/point_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace espalier::environment {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();
constexpr double points_per_cell = 48;

std::vector<std::uint32_t> all_numbers(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

Box box_of(std::span<const glm::dvec3> points) {
    Box box;
    for (const glm::dvec3& point : points) box.add(point);
    return box;
}

/// Where the nodes of one step are in the next; none if one of them is not as it was.
std::optional<std::vector<std::uint32_t>> numbers_in(const std::unordered_map<std::uint64_t, std::uint32_t>& numbers,
                                                     std::span<const ColonizingNode> before,
                                                     std::span<const ColonizingNode> now) {
    std::vector<std::uint32_t> result;
    result.reserve(before.size());
    for (const ColonizingNode& node : before) {
        const auto found = numbers.find(node.key);
        if (found == numbers.end() || !(now[found->second] == node)) return std::nullopt;
        result.push_back(found->second);
    }
    return result;
}

}  // namespace

Colonization::Colonization(std::vector<glm::dvec3> points, ColonizationRules rules)
    : rules_(rules), points_(std::move(points)), left_(points_.size(), 1), count_left_(points_.size()) {
    sort_into_cells();
    forget_nodes();
}

void Colonization::sort_into_cells() {
    const Box cloud = box_of(points_);
    const glm::dvec3 edges = cloud.upper - cloud.lower;
    widest_ = std::max({edges.x, edges.y, edges.z, 1e-9});
    // A cloud may be flat.
    const glm::dvec3 thick = glm::max(edges, glm::dvec3(1e-3 * widest_));
    const double share = points_per_cell / static_cast<double>(points_.size());
    const PointGrid grid(points_, all_numbers(points_.size()), math::cbrt(thick.x * thick.y * thick.z * share));
    std::vector<glm::dvec3> sorted;
    sorted.reserve(points_.size());
    StopCheck<64> check;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        check();
        const auto first = static_cast<std::uint32_t>(sorted.size());
        Box box;
        for (const std::uint32_t member : grid.members(i)) {
            sorted.push_back(points_[member]);
            box.add(points_[member]);
        }
        const auto end = static_cast<std::uint32_t>(sorted.size());
        cells_.push_back({first, end, 0.5 * (box.lower + box.upper), 0.5 * (box.upper - box.lower), end - first});
    }
    points_ = std::move(sorted);
}

void Colonization::forget_nodes() {
    nearest_.assign(points_.size(), far_away);
    winning_.assign(points_.size(), far_away);
    winner_.assign(points_.size(), none);
}

void Colonization::set_nodes(std::vector<ColonizingNode> nodes) {
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    numbers.reserve(nodes.size());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) numbers.emplace(nodes[i].key, i);
    const auto renumbered = numbers_in(numbers, nodes_, nodes);
    std::vector<char> known(nodes.size(), 0);
    if (renumbered) {
        for (const std::uint32_t number : *renumbered) known[number] = 1;
        for_in_parallel(std::size_t{0}, winner_.size(), [&](std::size_t point) {
            if (winner_[point] != none) winner_[point] = (*renumbered)[winner_[point]];
        });
    } else {
        forget_nodes();
    }
    nodes_ = std::move(nodes);
    std::vector<std::uint32_t> added;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        if (!known[i]) added.push_back(i);
    }
    add(added);
}

void Colonization::add(std::span<const std::uint32_t> nodes) {
    if (nodes.empty()) return;
    std::vector<glm::dvec3> places;
    places.reserve(nodes_.size());
    for (const ColonizingNode& node : nodes_) places.push_back(node.position);
    const PointGrid grid(places, nodes, std::min(rules_.influence, std::max(widest_, 1e-6)));
    for_in_parallel(tbb::blocked_range<std::size_t>(0, cells_.size(), 8), [&](const auto& range) {
        std::vector<std::uint32_t> near;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Cell& cell = cells_[i];
            if (cell.left == 0) continue;
            near.clear();
            const double reach = rules_.influence + std::max({cell.half.x, cell.half.y, cell.half.z});
            grid.visit_around(cell.centre, std::min(reach, 1e100), [&](std::uint32_t node) {
                const glm::dvec3 beyond =
                    glm::max(glm::abs(nodes_[node].position - cell.centre) - cell.half, glm::dvec3(0));
                if (glm::dot(beyond, beyond) <= rules_.influence * rules_.influence * (1 + 1e-9)) near.push_back(node);
                return true;
            });
            offer(cell, near);
        }
    });
}

bool Colonization::perceives(const ColonizingNode& node, const glm::dvec3& towards, double distance) const {
    return rules_.cosine <= -1 || glm::dot(node.heading, towards) >= rules_.cosine * distance;
}

void Colonization::offer(const Cell& cell, std::span<const std::uint32_t> nodes) {
    const double farthest = rules_.influence * rules_.influence;
    for (std::uint32_t point = cell.first; point < cell.end; ++point) {
        if (!left_[point]) continue;
        for (const std::uint32_t number : nodes) {
            const ColonizingNode& node = nodes_[number];
            const glm::dvec3 towards = points_[point] - node.position;
            const double square = glm::dot(towards, towards);
            if (square > farthest) continue;
            nearest_[point] = std::min(nearest_[point], square);
            if (!node.is_bud || square > winning_[point]) continue;
            if (square == winning_[point] && nodes_[winner_[point]].key < node.key) continue;
            if (rules_.perceived && !perceives(node, towards, std::sqrt(square))) continue;
            winning_[point] = square;
            winner_[point] = number;
        }
    }
}

std::size_t Colonization::remove_within(double distance) {
    const double square = distance * distance;
    for_in_parallel(std::size_t{0}, cells_.size(), [&](std::size_t i) {
        Cell& cell = cells_[i];
        if (cell.left == 0) return;
        for (std::uint32_t point = cell.first; point < cell.end; ++point) {
            if (!left_[point] || nearest_[point] > square) continue;
            left_[point] = 0;
            --cell.left;
        }
    });
    const std::size_t before = count_left_;
    count_left_ = 0;
    for (const Cell& cell : cells_) count_left_ += cell.left;
    return before - count_left_;
}

std::vector<Colonization::Won> Colonization::won() const {
    std::vector<Won> won(nodes_.size());
    for (const Cell& cell : cells_) {
        if (cell.left == 0) continue;
        for (std::uint32_t point = cell.first; point < cell.end; ++point) {
            if (!left_[point] || winner_[point] == none) continue;
            const ColonizingNode& node = nodes_[winner_[point]];
            const glm::dvec3 towards = points_[point] - node.position;
            const double distance = glm::length(towards);
            if (distance == 0 || !perceives(node, towards, distance)) continue;
            won[winner_[point]].sum += towards / distance;
            ++won[winner_[point]].count;
        }
    }
    return won;
}

void Colonization::save(std::ostream& out) const {
    put_text(out, {left_.begin(), left_.end()});
}

void Colonization::restore(std::istream& in) {
    const std::string left = get_text(in, left_.size());
    if (left.size() != left_.size()) throw RunError("the checkpoint is of another cloud of markers");
    left_.assign(left.begin(), left.end());
    count_left_ = 0;
    for (Cell& cell : cells_) {
        cell.left = static_cast<std::uint32_t>(std::count(left_.begin() + cell.first, left_.begin() + cell.end, 1));
        count_left_ += cell.left;
    }
    nodes_.clear();
    forget_nodes();
}

}  // namespace espalier::environment
