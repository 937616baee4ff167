#include "archive/organ_table.h"

#include "archive/facet_areas.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace espalier::archive {
namespace {

/// A piece of an organ: an internode, a polygon, or a point.
class Pieces {
public:
    Pieces(const FrameGeometry& geometry, const std::filesystem::path& run)
        : geometry_(geometry), areas_(geometry, run) {}

    void add_lines() {
        const FrameGeometry& g = geometry_;
        for (std::size_t line = 0; line < g.lines.size(); ++line) {
            if (g.of_cells.kinds[g.lines.first + line] != Kind::axis) continue;
            const auto points = g.lines[line];
            for (std::size_t i = 1; i < points.size(); ++i) add_internode(points[i - 1], points[i]);
        }
    }

    void add_polygons() {
        const FrameCells& cells = geometry_.polygons;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            if (!cells[cell].empty()) add_surface(cells.first + cell, cells[cell], areas_.of(cell));
        }
    }

    void add_points() {
        const FrameCells& cells = geometry_.vertices;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            if (!cells[cell].empty()) add_surface(cells.first + cell, cells[cell], 0);
        }
    }

    /// One row for each module.
    std::vector<OrganRow> merged() {
        const auto by_key = [](const OrganRow& a, const OrganRow& b) { return a.key < b.key; };
        std::stable_sort(rows_.begin(), rows_.end(), by_key);
        std::vector<OrganRow> result;
        for (const OrganRow& row : rows_) {
            if (!result.empty() && result.back().key == row.key) {
                merge(result.back(), row);
            } else {
                result.push_back(row);
            }
        }
        for (OrganRow& row : result) {
            if (row.kind != Kind::axis) row.length = glm::distance(row.base, row.tip);
        }
        return result;
    }

private:
    OrganRow row_of(const FrameAttributes& of, std::size_t row, glm::vec3 base, glm::vec3 tip,
                    std::int32_t point) const {
        return {{of.plants[row], of.identities[row]},
                of.parents[row],
                of.births[row],
                of.symbols[row],
                of.orders[row],
                of.kinds[row],
                base,
                tip,
                0,
                0,
                0,
                0,
                point};
    }

    void add_internode(std::int32_t from, std::int32_t to) {
        const auto base = static_cast<std::size_t>(from), tip = static_cast<std::size_t>(to);
        OrganRow row = row_of(geometry_.of_points, tip, geometry_.points[base], geometry_.points[tip], to);
        row.kind = Kind::axis;
        row.base_radius = geometry_.radii[base];
        row.tip_radius = geometry_.radii[tip];
        row.length = glm::distance(row.base, row.tip);
        add(row);
    }

    void add_surface(std::size_t cell, std::span<const std::int32_t> corners, double area) {
        const auto corner = [&](std::size_t i) { return geometry_.points[static_cast<std::size_t>(corners[i])]; };
        OrganRow row = row_of(geometry_.of_cells, cell, corner(0), corner(0), corners[0]);
        for (std::size_t i = 1; i < corners.size(); ++i) {
            if (glm::distance(row.base, corner(i)) > glm::distance(row.base, row.tip)) row.tip = corner(i);
        }
        row.area = area;
        add(row);
    }

    // Pieces of one organ mostly follow each other.
    void add(const OrganRow& row) {
        if (!rows_.empty() && rows_.back().key == row.key) {
            merge(rows_.back(), row);
        } else {
            rows_.push_back(row);
        }
    }

    static void merge(OrganRow& whole, const OrganRow& piece) {
        whole.area += piece.area;
        if (piece.kind == Kind::axis && whole.kind == Kind::axis) {
            whole.length += piece.length;
            whole.tip = piece.tip;
            whole.tip_radius = piece.tip_radius;
            whole.point = piece.point;
        } else if (whole.kind != Kind::axis) {
            for (const glm::vec3& corner : {piece.base, piece.tip}) {
                if (glm::distance(whole.base, corner) > glm::distance(whole.base, whole.tip)) whole.tip = corner;
            }
        }
    }

    const FrameGeometry& geometry_;
    FacetAreas areas_;
    std::vector<OrganRow> rows_;
};

}  // namespace

OrganTable::OrganTable(const FrameGeometry& geometry, const std::filesystem::path& run)
    : symbol_names_(geometry.symbol_names) {
    gather(geometry, run);
    keep_parameters(geometry);
}

void OrganTable::gather(const FrameGeometry& geometry, const std::filesystem::path& run) {
    Pieces pieces(geometry, run);
    pieces.add_lines();  // first: what has an internode is one
    pieces.add_polygons();
    pieces.add_points();
    rows_ = pieces.merged();
}

void OrganTable::keep_parameters(const FrameGeometry& geometry) {
    for (const auto& [name, values] : geometry.parameters) parameter_names_.push_back(name);
    parameters_.reserve(rows_.size() * parameter_names_.size());
    for (const OrganRow& row : rows_) {
        for (const auto& [name, values] : geometry.parameters) {
            parameters_.push_back(values[static_cast<std::size_t>(row.point)]);
        }
    }
}

const OrganRow* OrganTable::find(const OrganKey& key) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), key,
                                        [](const OrganRow& row, const OrganKey& wanted) { return row.key < wanted; });
    return found != rows_.end() && found->key == key ? &*found : nullptr;
}

std::vector<double> OrganTable::parameters(const OrganRow& row, const std::vector<std::string>& names) const {
    const auto first = static_cast<std::size_t>(&row - rows_.data()) * parameter_names_.size();
    std::vector<double> values;
    for (const std::string& name : names) {
        const auto found = std::find(parameter_names_.begin(), parameter_names_.end(), name);
        const auto column = static_cast<std::size_t>(found - parameter_names_.begin());
        values.push_back(found == parameter_names_.end() ? std::numeric_limits<double>::quiet_NaN()
                                                         : parameters_[first + column]);
    }
    return values;
}

std::size_t OrganTable::bytes() const {
    return rows_.capacity() * sizeof(OrganRow) + parameters_.capacity() * sizeof(double);
}

}  // namespace espalier::archive
