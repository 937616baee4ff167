// The numbers of voxels, written and read by files that need nothing else of OpenVDB and its headers.
#pragma once

#include "espalier/geometry/field.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <span>

namespace espalier::geometry {

/// Metres. OpenVDB takes the volume of a smaller voxel for zero.
constexpr double smallest_voxel = 1.5e-5;

/// A field's grid in the making: voxels of edge `voxel`, that of (0, 0, 0) with its centre at `origin` + voxel/2;
/// `unset` where nothing is set.
class VoxelValues {
public:
    VoxelValues(double voxel, const glm::dvec3& origin, float unset = 0);
    ~VoxelValues();

    void set(const glm::ivec3& at, float value);
    void add(const glm::ivec3& at, float value);
    /// The values of `at` and the voxels behind it along z, `most` or less, to be changed; they are set now.
    std::span<float> row(const glm::ivec3& at, int most);
    /// Gives all voxels of a box that begins at (0, 0, 0) their values, x fastest; zeros are not set.
    void fill(const glm::ivec3& size, std::span<const float> values);
    /// A viewer should be shown all from `least` to `most`, too.
    void show(const glm::ivec3& least, const glm::ivec3& most);
    std::shared_ptr<const FieldGrid> grid() const;

private:
    struct Writing;
    std::unique_ptr<Writing> writing_;
};

/// Reads voxels that lie near each other fast.
class VoxelReader {
public:
    explicit VoxelReader(std::shared_ptr<const FieldGrid> field);
    ~VoxelReader();

    /// Of the voxel whose centre is nearest.
    float value(const glm::dvec3& place) const;
    /// Linear between the voxels around `index`, which counts in voxels from the centre of (0, 0, 0).
    double between(const glm::dvec3& index) const;

private:
    struct Reading;
    std::unique_ptr<Reading> reading_;
};

std::size_t bytes_held(const FieldGrid& field);

}  // namespace espalier::geometry
