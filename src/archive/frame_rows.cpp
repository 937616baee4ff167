#include "archive/frame_rows.h"

#include "archive/facet_areas.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace espalier::archive {
namespace {

using What = FrameRow::What;
using Visit = std::function<void(const FrameRow&)>;

void visit_internode(const FrameGeometry& geometry, const FrameInternode& internode, const Visit& visit) {
    const std::size_t point = internode.tip_point.row();
    FrameRow row{What::internode, geometry.of_points, point, point, internode.base, internode.tip};
    const double a = internode.base_radius, b = internode.tip_radius;
    row.length = glm::distance(internode.base, internode.tip);
    row.radius = (a + b) / 2;
    row.area = std::numbers::pi * (a + b) * std::sqrt(row.length * row.length + (a - b) * (a - b));
    row.volume = std::numbers::pi / 3 * row.length * (a * a + a * b + b * b);
    visit(row);
}

/// The polygons from `first` to before `end`.
void visit_organ(const FrameGeometry& geometry, const FacetAreas& areas, std::size_t first, std::size_t end,
                 const Visit& visit) {
    const auto corners = geometry.polygons[first];
    if (corners.empty()) return;
    const auto point = static_cast<std::size_t>(corners[0]);
    FrameRow row{What::organ, geometry.of_cells, geometry.polygons.first + first, point, geometry.points[point]};
    row.end = row.base;
    row.area = 0;
    for (std::size_t cell = first; cell < end; ++cell) {
        for (const auto number : geometry.polygons[cell]) {
            const glm::vec3 corner = geometry.points[static_cast<std::size_t>(number)];
            if (glm::distance(corner, row.base) > glm::distance(row.end, row.base)) row.end = corner;
        }
        row.area += areas.of(cell);
    }
    row.length = glm::distance(row.base, row.end);
    visit(row);
}

void visit_organs(const FrameGeometry& geometry, const std::filesystem::path& run, const Visit& visit) {
    const FrameAttributes& of = geometry.of_cells;
    const FacetAreas areas(geometry, run);
    const std::size_t cells = geometry.polygons.first;
    for (std::size_t first = 0, end = 0; first < geometry.polygons.size(); first = end) {
        const auto is_of_organ = [&](std::size_t cell) {
            return of.identities[cells + cell] == of.identities[cells + first] &&
                   of.kinds[cells + cell] == of.kinds[cells + first];
        };
        for (end = first + 1; end < geometry.polygons.size() && is_of_organ(end);) ++end;
        visit_organ(geometry, areas, first, end, visit);
    }
}

// What they were answered is a chosen parameter.
void visit_queries(const FrameGeometry& geometry, const Visit& visit) {
    const FrameAttributes& of = geometry.of_cells;
    for (std::size_t cell = 0; cell < geometry.vertices.size(); ++cell) {
        const std::size_t row = geometry.vertices.first + cell;
        const auto corners = geometry.vertices[cell];
        if (of.kinds[row] != Kind::query || corners.empty()) continue;
        const auto point = static_cast<std::size_t>(corners[0]);
        visit({What::query, of, row, point, geometry.points[point]});
    }
}

}  // namespace

const char* name_of(FrameRow::What what) {
    return what == What::internode ? "internode" : what == What::organ ? "organ" : "query";
}

void for_each_row(const FrameGeometry& geometry, const std::filesystem::path& run, const Visit& visit) {
    for (const FrameInternode& internode : internodes_of(geometry)) visit_internode(geometry, internode, visit);
    visit_organs(geometry, run, visit);
    visit_queries(geometry, visit);
}

}  // namespace espalier::archive
