// Attraction points and the nodes that compete for them.
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/module_string.h"

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <span>
#include <vector>

namespace espalier::environment {

/// A node of a plant: where a point may be won. `is_bud` false: it only takes space.
struct ColonizingNode {
    std::uint64_t key = 0;  ///< the same for a node in every step; of equals in distance the least wins
    glm::dvec3 position{0};
    glm::dvec3 heading{0, 1, 0};
    bool is_bud = true;
    bool operator==(const ColonizingNode&) const = default;
};

struct ColonizationRules {
    double influence = std::numeric_limits<double>::infinity();  ///< m; from farther no point attracts
    double cosine = -1;      ///< cosine of half the angle of perception about the heading
    bool perceived = false;  ///< points go to the nearest of the nodes that perceive them, not of all
};

/// Keeps, for every point, its nearest node, so that a step costs what its new nodes cost. Nodes that vanish, move or
/// turn into buds cost a search for all.
class Colonization {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    Colonization(std::vector<glm::dvec3> points, ColonizationRules rules);

    /// These are the nodes now.
    void set_nodes(std::vector<ColonizingNode> nodes);
    /// Removes the points within `distance` of a node; it is at most the influence. Returns how many.
    std::size_t remove_within(double distance);

    /// The sum of the unit vectors from a node to the points it has won, and their number.
    struct Won {
        std::uint32_t count = 0;
        glm::dvec3 sum{0};
    };
    /// Returns what each node has won, in their order. Points outside the angle of perception attract no node.
    std::vector<Won> won() const;

    std::span<const glm::dvec3> points() const { return points_; }
    bool is_left(std::size_t point) const { return left_[point] != 0; }
    std::size_t left() const { return count_left_; }
    static constexpr std::size_t bytes_per_point = 56;

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    /// Points that lie together: a range of them, and the box around it.
    struct Cell {
        std::uint32_t first, end;
        glm::dvec3 centre, half;
        std::uint32_t left;
    };

    void sort_into_cells();
    void forget_nodes();
    void add(std::span<const std::uint32_t> nodes);
    void offer(const Cell& cell, std::span<const std::uint32_t> nodes);
    bool perceives(const ColonizingNode& node, const glm::dvec3& towards, double distance) const;

    ColonizationRules rules_;
    std::vector<glm::dvec3> points_;  ///< cell by cell
    std::vector<std::uint8_t> left_;
    std::vector<double> nearest_;        ///< square of the distance to the nearest node, bud or not
    std::vector<double> winning_;        ///< to the winner
    std::vector<std::uint32_t> winner_;  ///< a node, or `none`
    std::vector<Cell> cells_;
    double widest_ = 0;  ///< m; the longest edge of the cloud
    std::size_t count_left_ = 0;
    std::vector<ColonizingNode> nodes_;
};

}  // namespace espalier::environment
