#include "geometry/drawn/rigid_motion.h"

#include "espalier/base/math.h"

namespace espalier::geometry {
namespace {

void move_polygons(PlantGeometry& geometry, const MotionOfModule& motion_of) {
    for (const Polygon& polygon : geometry.polygons) {
        glm::dvec3* const vertices = &geometry.vertices[polygon.first];
        const RigidMotion* const motion = motion_of(polygon.module, vertices[0]);
        for (std::uint32_t i = 0; motion && i < polygon.count; ++i) vertices[i] = motion->point(vertices[i]);
    }
}

void move_mesh(DrawnMesh& mesh, const MotionOfModule& motion_of) {
    std::vector<bool> moved(mesh.vertices.size(), false);
    for (const MeshPiece& piece : mesh.pieces) {
        if (piece.count == 0) continue;
        const RigidMotion* const motion = motion_of(piece.module, mesh.vertices[mesh.triangles[piece.first]].position);
        for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i) {
            const std::uint32_t corner = mesh.triangles[i];
            SurfaceVertex& vertex = mesh.vertices[corner];
            if (motion && !moved[corner]) {
                vertex.position = motion->point(vertex.position);
                vertex.normal = motion->direction(vertex.normal);
            }
            moved[corner] = true;
        }
    }
}

void move_pose(Pose& pose, const RigidMotion& motion) {
    pose = {motion.point(pose.position), motion.direction(pose.heading), motion.direction(pose.left),
            motion.direction(pose.up)};
}

}  // namespace

glm::dquat turn_about(const glm::dvec3& axis, double angle) {
    const math::SineAndCosine half = math::sine_and_cosine(angle / 2);
    return {half.cosine, half.sine * axis};
}

void move_organs(PlantGeometry& geometry, const MotionOfModule& motion_of) {
    move_polygons(geometry, motion_of);
    move_mesh(geometry.mesh, motion_of);
    for (Organ& organ : geometry.organs) {
        if (const RigidMotion* motion = motion_of(organ.module, organ.pose.position)) move_pose(organ.pose, *motion);
    }
    for (Label& label : geometry.labels) {
        if (const RigidMotion* motion = motion_of(label.module, label.position))
            label.position = motion->point(label.position);
    }
}

}  // namespace espalier::geometry
