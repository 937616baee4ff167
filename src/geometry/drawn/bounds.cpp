#include "geometry/drawn/bounds.h"

#include <cmath>

namespace espalier::geometry {
namespace {

void add_ball(Box& box, const glm::dvec3& centre, double radius) {
    box.add(centre - radius);
    box.add(centre + radius);
}

void add_surface(Box& box, const Organ& organ, const Surface& surface) {
    const auto add = [&](const glm::dvec3& point) {
        const glm::dvec3 scaled = organ.size * point;
        box.add(organ.pose.position + scaled.x * organ.pose.left + scaled.y * organ.pose.heading +
                scaled.z * organ.pose.up);
    };
    for (const BicubicPatch& patch : surface.patches) {
        for (const auto& row : patch.points) {
            for (const glm::dvec3& point : row) add(point);
        }
    }
    for (const auto& triangle : surface.triangles) {
        for (const SurfaceVertex& vertex : triangle) add(vertex.position);
    }
}

void add_organ(Box& box, const Organ& organ, const Shapes* shapes) {
    if (organ.shape != Organ::Shape::surface) return add_ball(box, organ.pose.position, std::abs(organ.size.x) / 2);
    box.add(organ.pose.position);
    if (!shapes) return;
    const auto surface = shapes->surfaces.find(organ.surface);
    if (surface != shapes->surfaces.end()) add_surface(box, organ, surface->second);
}

}  // namespace

Box drawn_bounds(const PlantGeometry& geometry) {
    Box box;
    for (const Internode& internode : geometry.internodes) {
        add_ball(box, internode.base, internode.base_radius);
        add_ball(box, internode.tip, internode.tip_radius);
    }
    for (const glm::dvec3& vertex : geometry.vertices) box.add(vertex);
    for (const SurfaceVertex& vertex : geometry.mesh.vertices) box.add(vertex.position);
    for (const Label& label : geometry.labels) box.add(label.position);
    for (const Organ& organ : geometry.organs) add_organ(box, organ, geometry.shapes.get());
    return box;
}

}  // namespace espalier::geometry
