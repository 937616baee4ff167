// Points by place: which of them lie in a box, without asking all.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace espalier {

/// A hash grid of cubic cells. Only cells that hold points exist, so that neither the size of the world nor that of a
/// cell costs memory.
class PointGrid {
public:
    /// Of the points whose numbers `members` lists; within a cell they keep its order. Copies the positions.
    /// Cells are made larger than `edge` where that is too fine for the precision of the coordinates.
    PointGrid(std::span<const glm::dvec3> points, std::span<const std::uint32_t> members, double edge);

    double edge() const { return edge_; }

    /// Calls visit(point) for the points in the cell of the point at `place` until it returns false. False if it did.
    template <class Visit>
    bool visit_cell(const glm::dvec3& place, const Visit& visit) const {
        return visit_one(cell_of(place), visit);
    }

    /// The same for all cells that touch the cube around `centre` with half its side `reach`: a superset of the points
    /// within the distance `reach`, whatever is lost in rounding.
    template <class Visit>
    bool visit_around(const glm::dvec3& centre, double reach, const Visit& visit) const {
        const glm::dvec3 half = glm::dvec3(reach * (1 + 1e-9)) + 1e-15 * glm::abs(centre);
        const Cell lower = cell_of(glm::clamp(centre - half, least_, most_));
        const Cell upper = cell_of(glm::clamp(centre + half, least_, most_));
        if (count(lower, upper) > static_cast<double>(cells_.size())) return visit_all_in(lower, upper, visit);
        for (std::int64_t x = lower.x; x <= upper.x; ++x) {
            for (std::int64_t y = lower.y; y <= upper.y; ++y) {
                for (std::int64_t z = lower.z; z <= upper.z; ++z) {
                    if (!visit_one({x, y, z}, visit)) return false;
                }
            }
        }
        return true;
    }

private:
    struct Cell {
        std::int64_t x, y, z;
        auto operator<=>(const Cell&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Cell& cell) const;
    };
    struct Range {
        Cell cell;
        std::uint32_t begin, end;
    };

    Cell cell_of(const glm::dvec3& place) const {
        const glm::dvec3 cell = glm::floor(place / edge_);
        return {static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                static_cast<std::int64_t>(cell.z)};
    }

    static double count(const Cell& lower, const Cell& upper) {
        return static_cast<double>(upper.x - lower.x + 1) * static_cast<double>(upper.y - lower.y + 1) *
               static_cast<double>(upper.z - lower.z + 1);
    }

    template <class Visit>
    bool visit_range(const Range& range, const Visit& visit) const {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            if (!visit(members_[i])) return false;
        }
        return true;
    }

    template <class Visit>
    bool visit_one(const Cell& cell, const Visit& visit) const {
        const auto found = by_cell_.find(cell);
        return found == by_cell_.end() || visit_range(cells_[found->second], visit);
    }

    template <class Visit>
    bool visit_all_in(const Cell& lower, const Cell& upper, const Visit& visit) const {
        for (const Range& range : cells_) {
            const Cell& cell = range.cell;
            const bool inside = cell.x >= lower.x && cell.x <= upper.x && cell.y >= lower.y && cell.y <= upper.y &&
                                cell.z >= lower.z && cell.z <= upper.z;
            if (inside && !visit_range(range, visit)) return false;
        }
        return true;
    }

    double edge_ = 1;
    glm::dvec3 least_{0}, most_{0};  ///< the corners of all points
    std::vector<std::uint32_t> members_;
    std::vector<Range> cells_;  ///< in lexicographic order
    std::unordered_map<Cell, std::uint32_t, Hash> by_cell_;
};

}  // namespace espalier
