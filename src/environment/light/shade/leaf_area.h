// How much leaf a ray of light passes: the area of all that plants have drawn flat, in voxels.
#pragma once

#include "espalier/environment/environment_process.h"

#include <glm/vec3.hpp>

#include <memory>
#include <span>

namespace espalier::environment {

/// Polygons, patches, discs and surfaces count; each is in the voxel of its middle. Voxels are [i, i + 1) times
/// `voxel`.
class LeafArea {
public:
    explicit LeafArea(double voxel);
    ~LeafArea();

    /// Forgets what was there, and takes the leaves of these plants.
    void collect(std::span<const PlantView> plants);
    /// Leaf area that a ray crosses from a point on, per area across the ray; it turns in all directions evenly.
    double crossed(const glm::dvec3& from, const glm::dvec3& direction) const;
    /// m^2, of all voxels.
    double total() const { return total_; }

private:
    struct Voxels;
    void add(const glm::dvec3& middle, double area);

    double voxel_, total_ = 0;
    std::unique_ptr<Voxels> voxels_;
};

}  // namespace espalier::environment
