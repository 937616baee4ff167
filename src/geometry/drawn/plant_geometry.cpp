#include "espalier/geometry/plant_geometry.h"

#include "geometry/drawn/columns.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <numbers>

namespace espalier::geometry {

void Box::add(const glm::dvec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

void Box::add(const Box& box) {
    lower = glm::min(lower, box.lower);
    upper = glm::max(upper, box.upper);
}

void PlantGeometry::clear() {
    for_drawn_columns(*this, [](auto& column) { column.clear(); });
    shapes.reset();
    in_pixels = false;
    axes = 0;
    bounds = Box{};
}

bool PlantGeometry::is_empty() const {
    bool is_empty = true;
    for_drawn_columns(*this, [&](const auto& column) { is_empty = is_empty && column.empty(); });
    return is_empty;
}

double total_length(const PlantGeometry& geometry) {
    double sum = 0;
    for (const Internode& internode : geometry.internodes) sum += glm::distance(internode.base, internode.tip);
    return sum;
}

double total_volume(const PlantGeometry& geometry) {
    double sum = 0;
    for (const Internode& internode : geometry.internodes) {
        const double r = internode.base_radius, s = internode.tip_radius;
        sum += std::numbers::pi / 3 * glm::distance(internode.base, internode.tip) * (r * r + r * s + s * s);
    }
    return sum;
}

}  // namespace espalier::geometry
