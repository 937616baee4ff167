#include "environment/shade/drawn_leaves.h"

#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <numbers>

namespace espalier::environment {

void DrawnLeaves::collect(const PlantGeometry& geometry) {
    modules_.clear();
    colours_.clear();
    corners_.clear();
    ends_.assign(1, 0);
    for (const Polygon& polygon : geometry.polygons) {
        add(polygon.module, polygon.colour, {&geometry.vertices[polygon.first], polygon.count});
    }
    add_patches(geometry.mesh);
    add_organs(geometry);
}

void DrawnLeaves::add(std::uint32_t module, std::uint16_t colour, std::span<const glm::dvec3> corners) {
    if (corners.empty()) return;
    modules_.push_back(module);
    colours_.push_back(colour);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    ends_.push_back(corners_.size());
}

void DrawnLeaves::add_patches(const DrawnMesh& mesh) {
    for (const MeshPiece& piece : mesh.pieces) {
        if (piece.kind != MeshPiece::Kind::patch) continue;
        for (std::uint32_t i = piece.first; i + 2 < piece.first + piece.count; i += 3) {
            const glm::dvec3 corners[] = {mesh.vertices[mesh.triangles[i]].position,
                                          mesh.vertices[mesh.triangles[i + 1]].position,
                                          mesh.vertices[mesh.triangles[i + 2]].position};
            add(piece.module, piece.colour, corners);
        }
    }
}

void DrawnLeaves::add_organs(const PlantGeometry& geometry) {
    std::map<std::uint32_t, SurfaceMesh> surfaces;
    for (const Organ& organ : geometry.organs) {
        if (organ.shape == Organ::Shape::disc) add_disc(organ);
        if (organ.shape != Organ::Shape::surface || !geometry.shapes) continue;
        const auto shape = geometry.shapes->surfaces.find(organ.surface);
        if (shape == geometry.shapes->surfaces.end()) continue;
        const auto [known, is_new] = surfaces.try_emplace(organ.surface);
        if (is_new) known->second = mesh_of(shape->second);
        add_surface(organ, known->second);
    }
}

void DrawnLeaves::add_surface(const Organ& organ, const SurfaceMesh& mesh) {
    const Pose& pose = organ.pose;
    std::vector<glm::dvec3> corners;
    std::size_t next = 0;
    for (const std::uint32_t count : mesh.faces) {
        corners.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::dvec3 scaled = organ.size * mesh.vertices[mesh.indices[next++]].position;
            corners.push_back(pose.position + scaled.x * pose.left + scaled.y * pose.heading + scaled.z * pose.up);
        }
        add(organ.module, organ.colour, corners);
    }
}

void DrawnLeaves::add_disc(const Organ& organ) {
    const double half = organ.size.x / 4 * std::sqrt(std::numbers::pi);
    const glm::dvec3 along = half * organ.pose.heading, across = half * organ.pose.left, at = organ.pose.position;
    const glm::dvec3 corners[] = {at - along - across, at + along - across, at + along + across, at - along + across};
    add(organ.module, organ.colour, corners);
}

glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
    return geometry::area_vector(corners.size(), [&](std::size_t i) { return corners[i]; });
}

glm::dvec3 middle_of(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
}

}  // namespace espalier::environment
