// ulam: cells are born next to exactly one living cell.
// Ulam 1962, On some mathematical problems connected with patterns of growth of figures; Schrandt & Ulam 1967.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/space/neighbours/point_grid.h"
#include "environment/space/neighbours/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace espalier::environment {
namespace {

/// A place where a cell lives or may be born. However many queries stand there, they are one cell.
struct Cell {
    glm::dvec3 place;
    bool alive = false;
    int edges = 0;         ///< living edge neighbours
    glm::dvec3 parent{0};  ///< where one of them stands, that of the greatest coordinates
    int corners = 0;       ///< living corner neighbours that do not border the parent
};

class Ulam final : public EnvironmentProcess {
public:
    Ulam(Settings& settings, const EnvironmentContext& context, Fields&)
        : rule_(settings.choice_or("rule", "simple", {"simple", "births", "eligible", "wishes"})),
          edge_(settings.number_or("edge", 1, Range::positive())),
          corner_(settings.number_or("corner", 1.4143 * edge_, Range::between(0, 8 * edge_))),
          tolerance_(0.01 * edge_),
          statistics_(context.plants) {}

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        find_cells(queries);
        const PointGrid grid(places_, numbers_up_to(places_.size()), edge_);
        for_in_parallel(std::size_t{0}, cells_.size(), [&](std::size_t i) { count_living(grid, cells_[i]); });
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            const Cell& cell = cells_[cell_of_[i]];
            const int corners = cell.corners + rivals(grid, cell);
            const bool born = cell.edges == 1 && !cell.alive && (rule_ == "simple" || corners == 0);
            if (queries[i].parameters[0] <= 0) answers[i][0] = born ? 1 : 0;
            if (answers[i].size() > 1) answers[i][1] = cell.edges;
            if (answers[i].size() > 2) answers[i][2] = corners;
        });
        sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return statistics_.counts(plant, "born", "refused");
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::reach; }
    // Rivals at a corner count, whose own corners and edges decide whether they are rivals; the rest is for cells that
    // are one within the tolerance.
    Box reach(const Query& query) const override {
        return box_around(query.pose.position, glm::dvec3(2 * std::max(edge_, corner_) + 10 * tolerance_));
    }

private:
    static std::vector<std::uint32_t> numbers_up_to(std::size_t count) {
        std::vector<std::uint32_t> numbers(count);
        std::iota(numbers.begin(), numbers.end(), 0U);
        return numbers;
    }

    void find_cells(Queries queries) {
        const std::vector<std::uint32_t> first = first_at_the_place(queries);
        cells_.clear();
        places_.clear();
        cell_of_.resize(queries.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (first[i] == i) {
                places_.push_back(queries[i].pose.position);
                cells_.push_back({places_.back()});
            }
            cell_of_[i] = first[i] == i ? static_cast<std::uint32_t>(cells_.size() - 1) : cell_of_[first[i]];
            if (queries[i].parameters[0] > 0) cells_[cell_of_[i]].alive = true;
        }
    }

    // Turtles reach one place by different ways: what is nearer than the tolerance is the same place. First within
    // small boxes, so that a crowd costs no more than its members, then across their walls.
    std::vector<std::uint32_t> first_at_the_place(Queries queries) const {
        std::vector<glm::dvec3> points;
        for (const Query& query : queries) points.push_back(query.pose.position);
        std::vector<std::uint32_t> first = numbers_up_to(points.size()), heads;
        const PointGrid boxes(points, first, tolerance_ / 2);
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            boxes.visit_cell(points[i], [&](std::uint32_t head) {
                first[i] = head;
                return false;
            });
            if (first[i] == i) heads.push_back(i);
        }
        const PointGrid among_heads(points, heads, tolerance_);
        for (const std::uint32_t i : heads) {
            among_heads.visit_around(points[i], tolerance_, [&](std::uint32_t other) {
                if (other < first[i] && glm::distance(points[other], points[i]) <= tolerance_) first[i] = other;
                return true;
            });
        }
        for (std::uint32_t i = 0; i < points.size(); ++i) first[i] = first[first[i]];
        return first;
    }

    bool at_edge(const glm::dvec3& a, const glm::dvec3& b) const {
        return std::abs(glm::distance(a, b) - edge_) < tolerance_;
    }

    // Cells that border the parent too, its other daughters and its own parent, do not count.
    bool at_corner(const Cell& cell, const Cell& other) const {
        const double apart = glm::distance(other.place, cell.place);
        const bool touches = apart > edge_ + tolerance_ && apart < corner_ + tolerance_;
        return touches && !(cell.edges > 0 && at_edge(cell.parent, other.place));
    }

    static bool comes_later(const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) > std::tie(b.x, b.y, b.z);
    }

    void count_living(const PointGrid& grid, Cell& cell) const {
        grid.visit_around(cell.place, edge_ + tolerance_, [&](std::uint32_t i) {
            if (!cells_[i].alive || !at_edge(cells_[i].place, cell.place)) return true;
            if (++cell.edges == 1 || comes_later(cells_[i].place, cell.parent)) cell.parent = cells_[i].place;
            return true;
        });
        grid.visit_around(cell.place, corner_ + tolerance_, [&](std::uint32_t i) {
            if (cells_[i].alive && at_corner(cell, cells_[i])) ++cell.corners;
            return true;
        });
    }

    // Cells that do not live yet and touch at a corner.
    int rivals(const PointGrid& grid, const Cell& cell) const {
        if (rule_ == "simple" || cell.alive) return 0;
        int count = 0;
        grid.visit_around(cell.place, corner_ + tolerance_, [&](std::uint32_t i) {
            const Cell& other = cells_[i];
            if (!other.alive && excludes(other) && at_corner(cell, other)) ++count;
            return true;
        });
        return count;
    }

    bool excludes(const Cell& candidate) const {
        if (rule_ == "wishes") return true;
        return candidate.edges == 1 && (rule_ == "eligible" || candidate.corners == 0);
    }

    void sum_up(Queries queries, std::span<const Answer> answers) {
        statistics_.clear();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (queries[i].parameters[0] <= 0) statistics_.add(queries[i].plant, answers[i][0]);
        }
    }

    std::string rule_;
    double edge_, corner_, tolerance_;
    std::vector<Cell> cells_;
    std::vector<glm::dvec3> places_;      ///< places of the cells
    std::vector<std::uint32_t> cell_of_;  ///< cell of each query
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"ulam", "cells are born next to exactly one living cell (Ulam 1962)",
     R"(?name(s)       s > 0: a living cell is here (s keeps its value); every living cell must send this in every step.
               s <= 0: may a cell be born here? -> 1 or 0
?name(s, n)    n -> living edge neighbours
?name(s, n, c) c -> corner neighbours that count: all except those that also touch the parent of the cell
Further parameters (at most 20 in all) keep their values. Positions within a hundredth of an edge are the same cell.

rule    "simple", or "births", "eligible", "wishes"; simple: a cell is born where exactly one living cell is an edge
        neighbour (1, 5, 9, 21, 25, 37, 49, 85 ...). births: and no living cell, and no cell that could be born in this
        step, touches a corner (A170896 if the cells born last ask). eligible: and no candidate with exactly one living
        edge neighbour touches a corner either, born or not (A267190 if the cells born last ask). wishes: and no other
        candidate at all touches a corner (A151895 if all living cells ask)
edge    1 m, > 0; distance of cells that share an edge
corner  1.4143 times the edge, m, >= 0; greatest distance of cells that touch; at most 8 edges

There is no grid: the positions of the queries make square, hexagonal, triangular or cubic patterns.
Statistics of a plant: born and refused, the answers 1 and 0.
)",
     construct<Ulam>}};

}  // namespace
}  // namespace espalier::environment
