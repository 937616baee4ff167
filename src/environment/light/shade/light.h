// The light at a point, with what one query casts itself taken away.
#pragma once

#include "environment/light/shade/field.h"

#include <array>

namespace espalier::environment {

/// Where voxels lie in space: about the middle of a domain, or else with the centre of voxel (0, 0, 0) at the origin.
struct ShadeLattice {
    double voxel = 0.5;    ///< metres
    glm::dvec3 centre{0};  ///< centre of voxel (0, 0, 0)
    bool flat = false;
    bool trilinear = true;
    bool fixed = false;     ///< only the voxels of `domain` exist
    bool periodic = false;  ///< the domain repeats along x and z
    VoxelBox domain;

    /// The voxel that holds `point`. Throws RunError for a point too far away to be numbered.
    glm::ivec3 voxel_of(const glm::dvec3& point) const;
    /// In voxels, from the centre of voxel (0, 0, 0).
    glm::dvec3 index_of(const glm::dvec3& point) const;
    /// The same voxel in the period that is stored.
    glm::ivec3 wrapped(glm::ivec3 voxel) const;
    /// False outside a fixed domain, where there is nothing but full light.
    bool reaches(const glm::dvec3& index) const;
    /// The nearest voxel of a fixed domain.
    void stay_inside(glm::ivec3& at) const;
};

class ShadeLight {
public:
    ShadeLight(const ShadeLattice& lattice, const ShadeCasts& casts, const ShadeField& field)
        : lattice_(lattice), casts_(casts), field_(field) {}

    /// Light at `point` without the pyramids `own`.
    double at(const glm::dvec3& point, std::span<const ShadeCast> own) const;
    /// Its gradient by central differences over `radius` metres, per metre.
    glm::dvec3 gradient(const glm::dvec3& point, double radius, std::span<const ShadeCast> own) const;

    /// Has the memory brought near that `at` will read.
    void fetch(const glm::dvec3& point) const;

private:
    /// The first of the eight voxels around a point, and where between them the point lies. Beyond the outermost
    /// centres of a fixed domain its outermost voxels count alone.
    struct Corner {
        glm::ivec3 voxel;
        glm::dvec3 part;
    };

    double of_voxel(const glm::ivec3& voxel, std::span<const ShadeCast> own) const;
    double left_by(Shade shade, const glm::ivec3& voxel, std::span<const ShadeCast> own) const;
    double interpolated(const glm::dvec3& point, std::span<const ShadeCast> own) const;
    template <class LightOf>
    double interpolated(const Corner& corner, const LightOf& light_of) const;
    Corner corner_of(const glm::dvec3& point) const;
    const Shade* sums_around(const glm::ivec3& voxel) const;

    const ShadeLattice& lattice_;
    const ShadeCasts& casts_;
    const ShadeField& field_;
};

}  // namespace espalier::environment
