// Leaf area in voxels, piece by piece.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include "environment/canopy/leaf_angles.h"
#include "environment/canopy/medium.h"
#include "geometry/drawn/faces.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

/// A part of a leaf that lies in one voxel.
struct LeafPiece {
    std::uint32_t plant, module;
    glm::dvec3 middle;
    glm::vec3 area;         ///< m2, along the normal; (area, 0, 0) if it is undirected
    bool undirected;        ///< inclined as a distribution says
    std::size_t voxel = 0;  ///< once sorted
};

class CanopyLeaves {
public:
    void clear();
    /// Everything flat that the plant has drawn, cut into pieces no longer than `longest`, metres.
    void add(std::uint32_t plant, const PlantGeometry& geometry, double longest);
    /// Area (m2) at a place, without a direction of its own.
    void add(std::uint32_t plant, std::uint32_t module, const glm::dvec3& place, double area);

    const Box& bounds() const { return bounds_; }
    std::span<const LeafPiece> pieces() const { return pieces_; }

    /// Gives each piece its voxel, and brings pieces of a voxel together.
    void sort_into(const CanopyVoxels& voxels);
    /// Leaf area per volume of each voxel, 1/m.
    std::vector<float> densities(const CanopyVoxels& voxels) const;
    /// The same as seen from a direction.
    std::vector<float> depths(const CanopyVoxels& voxels, const glm::dvec3& towards, const LeafAngles& angles) const;

private:
    void cut(std::uint32_t plant, std::uint32_t module, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
             double longest);
    void add(const LeafPiece& piece);
    template <class AreaOf>
    std::vector<float> per_volume(const CanopyVoxels& voxels, const AreaOf& area_of) const;

    std::vector<LeafPiece> pieces_;
    DrawnFaces drawn_;
    Box bounds_;
};

/// Area of a piece as seen from a direction; `projection` is that of the distribution for undirected ones.
double seen_area(const LeafPiece& piece, const glm::dvec3& towards, double projection);

double area_of(const LeafPiece& piece);

}  // namespace espalier::environment
