#include "environment/shade/leaf_area.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <openvdb/math/DDA.h>
#include <openvdb/math/Ray.h>

#include <map>
#include <numbers>
#include <numeric>
#include <vector>

namespace espalier::environment {

LeafArea::LeafArea(double voxel) : voxel_(voxel) {
    initialize_openvdb();
    areas_ = openvdb::FloatGrid::create(0);
}

void LeafArea::collect(std::span<const PlantView> plants) {
    areas_->clear();
    box_.reset();
    total_ = 0;
    for (const PlantView& plant : plants) add(plant.interpretation->geometry);
}

void LeafArea::add(const glm::dvec3& middle, double area) {
    const glm::dvec3 at = glm::floor(middle / voxel_);
    const openvdb::Coord voxel(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z));
    areas_->tree().setValue(voxel, areas_->tree().getValue(voxel) + static_cast<float>(area));
    box_.expand(voxel);
    total_ += area;
}

void LeafArea::add_polygon(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0), twice(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        sum += corners[i];
        twice += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    if (!corners.empty()) add(sum / static_cast<double>(corners.size()), glm::length(twice) / 2);
}

void LeafArea::add_surface(const Organ& organ, const SurfaceMesh& mesh) {
    const Pose& pose = organ.pose;
    std::vector<glm::dvec3> corners;
    std::size_t next = 0;
    for (const std::uint32_t count : mesh.faces) {
        corners.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::dvec3 scaled = organ.size * mesh.vertices[mesh.indices[next++]].position;
            corners.push_back(pose.position + scaled.x * pose.left + scaled.y * pose.heading + scaled.z * pose.up);
        }
        add_polygon(corners);
    }
}

void LeafArea::add(const PlantGeometry& geometry) {
    for (const Polygon& polygon : geometry.polygons) add_polygon({&geometry.vertices[polygon.first], polygon.count});
    const DrawnMesh& mesh = geometry.mesh;
    for (const MeshPiece& piece : mesh.pieces) {
        if (piece.kind != MeshPiece::Kind::patch) continue;
        for (std::uint32_t i = piece.first; i + 2 < piece.first + piece.count; i += 3) {
            const glm::dvec3 corners[] = {mesh.vertices[mesh.triangles[i]].position,
                                          mesh.vertices[mesh.triangles[i + 1]].position,
                                          mesh.vertices[mesh.triangles[i + 2]].position};
            add_polygon(corners);
        }
    }
    std::map<std::uint32_t, SurfaceMesh> surfaces;
    for (const Organ& organ : geometry.organs) {
        if (organ.shape == Organ::Shape::disc) {
            add(organ.pose.position, std::numbers::pi / 4 * organ.size.x * organ.size.x);
        } else if (organ.shape == Organ::Shape::surface && geometry.shapes) {
            const auto shape = geometry.shapes->surfaces.find(organ.surface);
            if (shape == geometry.shapes->surfaces.end()) continue;
            const auto [known, is_new] = surfaces.try_emplace(organ.surface);
            if (is_new) known->second = mesh_of(shape->second);
            add_surface(organ, known->second);
        }
    }
}

double LeafArea::crossed(const glm::dvec3& from, const glm::dvec3& direction) const {
    if (box_.empty()) return 0;
    using VoxelRay = openvdb::math::Ray<double>;
    const glm::dvec3 eye = from / voxel_;
    VoxelRay ray({eye.x, eye.y, eye.z}, {direction.x, direction.y, direction.z}, 0);
    const openvdb::Vec3d lower = box_.min().asVec3d(), upper = box_.max().asVec3d() + openvdb::Vec3d(1);
    if (!ray.clip(openvdb::math::BBox<openvdb::Vec3d>(lower, upper))) return 0;
    const auto areas = areas_->getConstAccessor();
    openvdb::math::DDA<VoxelRay> voxels(ray);
    double sum = 0;
    do {
        const double area = areas.getValue(voxels.voxel());
        if (area > 0) sum += area * (std::min(voxels.next(), ray.t1()) - voxels.time());
    } while (voxels.step());
    return sum / (voxel_ * voxel_);
}

}  // namespace espalier::environment
