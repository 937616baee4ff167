// The surface of a union of limbs by an OpenVDB level set: closed, whatever limbs meet.
#pragma once

#include "archive/meshes/limbs.h"

#include <array>
#include <memory>

namespace espalier::archive {

struct LimbMesh {
    std::vector<glm::dvec3> points, normals;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise seen from outside
};

/// A narrow band of three voxels on either side.
class LimbLevelSet {
public:
    /// `limbs` must outlive the level set. The voxel is a length in metres.
    LimbLevelSet(const LimbUnion& limbs, double voxel);
    ~LimbLevelSet();

    /// Every edge belongs to two triangles. Vertices lie on the surface of the union, not of the voxels; no vertex
    /// moves by more than half a voxel for that.
    LimbMesh mesh() const;
    /// m3, by OpenVDB.
    double volume() const;
    /// The pieces that matter near a point of the surface, sorted.
    std::span<const std::uint32_t> near(const glm::dvec3& point) const;

private:
    struct Body;
    std::unique_ptr<Body> body_;
};

}  // namespace espalier::archive
