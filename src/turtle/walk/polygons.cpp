// Polygons as a walk meets them: vertices now, the face when the group ends.
#include "espalier/turtle/walk.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::turtle {
namespace {

/// True if a polygon comes back to its first vertex, but for rounding.
bool meet(const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& last) {
    constexpr double rounding = 1e-9;
    return glm::distance(first, last) <= rounding * glm::distance(first, second);
}

}  // namespace

void OpenPolygons::begin(const Walk& walk, bool filled) {
    open_.push_back({vertices_.size(), walk.module(), filled, false, 0, {}});
}

// The colour of a polygon is that of its first vertex, as in cpfg. A `.` behind an `f` means the vertex that the `f`
// marked.
void OpenPolygons::add_vertex(const Walk& walk, bool by_step) {
    Open& polygon = open_.back();
    const glm::dvec3& position = walk.turtle().pose.position;
    const bool is_first = vertices_.size() == polygon.first;
    const bool is_marked = !by_step && !is_first && polygon.after_step && vertices_.back() == position;
    polygon.after_step = by_step;
    if (is_marked) return;
    if (is_first) {
        polygon.colour = std::uint16_t(walk.turtle().colour);
        polygon.look = walk.look();
    }
    vertices_.push_back(position);
}

void OpenPolygons::end(const Walk& walk) {
    // A cut may have taken the `{` away: then there is nothing to fill.
    if (open_.empty()) return;
    const Open polygon = open_.back();
    open_.pop_back();
    std::size_t count = vertices_.size() - polygon.first;
    if (count > 3 && meet(vertices_[polygon.first], vertices_[polygon.first + 1], vertices_.back())) --count;
    if (polygon.filled && count >= 3) {
        walk.geometry().polygons.push_back({polygon.module, std::uint32_t(walk.geometry().vertices.size()),
                                            std::uint32_t(count), walk.turtle().order, polygon.colour, polygon.look});
        const auto first = vertices_.begin() + std::ptrdiff_t(polygon.first);
        const auto last = first + std::ptrdiff_t(count);
        walk.geometry().vertices.insert(walk.geometry().vertices.end(), first, last);
        Box& bounds = walk.geometry().bounds;
        std::for_each(first, last, [&](const glm::dvec3& vertex) {
            bounds.lower = glm::min(bounds.lower, vertex);
            bounds.upper = glm::max(bounds.upper, vertex);
        });
    }
    vertices_.resize(polygon.first);
}

void OpenPolygons::clear() {
    open_.clear();
    vertices_.clear();
}

}  // namespace espalier::turtle
