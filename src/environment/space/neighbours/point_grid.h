// Points by place: which of them lie in a box, without asking all.
#pragma once

#include "environment/space/neighbours/reach.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

/// A hash grid of cubic cells. Only cells that hold points exist, so that neither the size of the world nor that of a
/// cell costs memory. Cells are numbered as their first members come; their table is probed linearly.
class PointGrid {
public:
    /// Holds the points whose numbers `members` lists; within a cell they keep its order.
    /// Cells are made larger than `edge` where that is too fine for the precision of the coordinates.
    PointGrid(std::span<const glm::dvec3> points, std::span<const std::uint32_t> members, double edge);

    /// Orders the members of every cell; equals stay as they are.
    template <class Less>
    void sort_cells(const Less& less) {
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const auto begin = members_.begin() + ends_[cell], end = members_.begin() + ends_[cell + 1];
            if (!std::is_sorted(begin, end, less)) std::stable_sort(begin, end, less);  // which takes memory
        }
    }

    std::size_t size() const { return cells_.size(); }
    std::span<const std::uint32_t> members(std::size_t cell) const {
        return {members_.data() + ends_[cell], members_.data() + ends_[cell + 1]};
    }

    /// Calls visit(point) for the points in the cell of the point at `place` until it returns false. False if it did.
    template <class Visit>
    bool visit_cell(const glm::dvec3& place, const Visit& visit) const {
        return visit_one(cell_of(place), visit);
    }

    /// The same for all cells that touch the cube around `centre` with half its side `reach`: a superset of the points
    /// within the distance `reach`, whatever is lost in rounding.
    template <class Visit>
    bool visit_around(const glm::dvec3& centre, double reach, const Visit& visit) const {
        return visit_around(centre, reach, nullptr, visit);
    }

    /// The same without the points of one of the cells.
    template <class Visit>
    bool visit_around_but(std::size_t cell, const glm::dvec3& centre, double reach, const Visit& visit) const {
        return visit_around(centre, reach, &cells_[cell], visit);
    }

private:
    struct Cell {
        std::int64_t x, y, z;
        bool operator==(const Cell&) const = default;
    };

    static constexpr std::uint32_t none = -1;

    static std::int64_t floor(double value) {
        const auto whole = static_cast<std::int64_t>(value);
        return whole - (value < static_cast<double>(whole));
    }

    Cell cell_of(const glm::dvec3& place) const {
        return {floor(place.x * per_edge_), floor(place.y * per_edge_), floor(place.z * per_edge_)};
    }

    static double count(const Cell& lower, const Cell& upper) {
        return static_cast<double>(upper.x - lower.x + 1) * static_cast<double>(upper.y - lower.y + 1) *
               static_cast<double>(upper.z - lower.z + 1);
    }

    /// Where the table holds the number of the cell, or an empty place for it.
    std::size_t slot_of(const Cell& cell) const {
        const auto bits = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
        const std::uint64_t sum = bits(cell.x) * 0x9E3779B97F4A7C15U + bits(cell.y) * 0xC2B2AE3D27D4EB4FU +
                                  bits(cell.z) * 0x165667B19E3779F9U;
        std::size_t slot = ((sum ^ (sum >> 32)) * 0xD6E8FEB86659FD93U) >> shift_;
        while (table_[slot] != none && cells_[table_[slot]] != cell) slot = (slot + 1) & (table_.size() - 1);
        return slot;
    }

    template <class Visit>
    bool visit_around(const glm::dvec3& centre, double reach, const Cell* left_out, const Visit& visit) const {
        const glm::dvec3 half = glm::dvec3(reach * beyond_rounding) + 1e-15 * glm::abs(centre);
        const Cell lower = cell_of(glm::clamp(centre - half, least_, most_));
        const Cell upper = cell_of(glm::clamp(centre + half, least_, most_));
        if (count(lower, upper) > static_cast<double>(cells_.size())) {
            return visit_all_in(lower, upper, left_out, visit);
        }
        for (std::int64_t x = lower.x; x <= upper.x; ++x) {
            for (std::int64_t y = lower.y; y <= upper.y; ++y) {
                for (std::int64_t z = lower.z; z <= upper.z; ++z) {
                    const Cell cell{x, y, z};
                    if (left_out != nullptr && cell == *left_out) continue;
                    if (!visit_one(cell, visit)) return false;
                }
            }
        }
        return true;
    }

    template <class Visit>
    bool visit_members(std::size_t cell, const Visit& visit) const {
        for (std::uint32_t i = ends_[cell]; i < ends_[cell + 1]; ++i) {
            if (!visit(members_[i])) return false;
        }
        return true;
    }

    template <class Visit>
    bool visit_one(const Cell& cell, const Visit& visit) const {
        if (table_.empty()) return true;
        const std::uint32_t number = table_[slot_of(cell)];
        return number == none || visit_members(number, visit);
    }

    template <class Visit>
    bool visit_all_in(const Cell& lower, const Cell& upper, const Cell* left_out, const Visit& visit) const {
        for (std::size_t number = 0; number < cells_.size(); ++number) {
            const Cell& cell = cells_[number];
            if (&cell == left_out) continue;
            const bool inside = cell.x >= lower.x && cell.x <= upper.x && cell.y >= lower.y && cell.y <= upper.y &&
                                cell.z >= lower.z && cell.z <= upper.z;
            if (inside && !visit_members(number, visit)) return false;
        }
        return true;
    }

    double per_edge_ = 1;
    glm::dvec3 least_{0}, most_{0};  ///< the corners of all points
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> ends_;     ///< where each cell's members end, behind a zero
    std::vector<std::uint32_t> members_;  ///< cell by cell
    std::vector<std::uint32_t> table_;    ///< numbers of cells
    int shift_ = 0;
};

}  // namespace espalier::environment
