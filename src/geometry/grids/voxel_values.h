// A field's grid from the numbers of single voxels, for files that need nothing else of OpenVDB and its headers.
#pragma once

#include "espalier/geometry/field.h"

#include <glm/vec3.hpp>

#include <memory>

namespace espalier::geometry {

/// Voxels of edge `voxel`, that of (0, 0, 0) with its centre at `origin` + voxel/2; 0 where nothing is set.
class VoxelValues {
public:
    VoxelValues(double voxel, const glm::dvec3& origin);
    ~VoxelValues();

    void set(const glm::ivec3& at, float value);
    void add(const glm::ivec3& at, float value);
    /// A viewer should be shown all from `least` to `most`, too.
    void show(const glm::ivec3& least, const glm::ivec3& most);
    std::shared_ptr<const FieldGrid> grid() const;

private:
    struct Writing;
    std::unique_ptr<Writing> writing_;
};

}  // namespace espalier::geometry
