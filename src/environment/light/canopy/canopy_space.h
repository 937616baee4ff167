// Where the voxels of a canopy lie.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/geometry/field.h"

#include "environment/light/canopy/medium.h"

#include <optional>

namespace espalier::environment {

/// Voxels over what there is, down to the ground if it scatters; those at the origin begin there.
class CanopySpace {
public:
    /// Reads `voxel`, `ground` and `periodic`, of which the sides of `domain` are the period.
    CanopySpace(const Settings& settings, const std::optional<Box>& domain, double usual_voxel);

    double edge() const { return edge_; }
    const Place& edge_place() const { return edge_place_; }

    /// In voxels.
    struct Extent {
        glm::dvec3 first, size;
        double count() const { return size.x * size.y * size.z; }
    };
    /// Of those over a box and down to the ground.
    Extent over(Box box) const;
    CanopyVoxels voxels(const Extent& extent) const;

private:
    double edge_;
    Place edge_place_;
    double ground_;
    std::optional<Box> period_;
};

}  // namespace espalier::environment
