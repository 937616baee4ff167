// A narrow-band level set of a closed mesh, read at points: value and gradient from one fetch of eight corners.
#pragma once

#include "espalier/base/error.h"

#include "environment/space/shapes/triangles.h"

#include <memory>
#include <string>

namespace espalier::environment {

class LevelSet {
public:
    /// Throws UserError if the level set would not fit into memory or no voxel of it is inside.
    LevelSet(const TriangleMesh& mesh, double voxel, const std::string& file, const Place& place);
    LevelSet(LevelSet&&) noexcept;
    ~LevelSet();

    struct Reading {
        bool near = false;    ///< within the band; else only the sign of `distance` counts
        double distance = 0;  ///< trilinear
        glm::dvec3 gradient{0, 0, 0};
    };
    Reading read(const glm::dvec3& point) const;

private:
    struct Storage;
    std::unique_ptr<const Storage> storage_;
};

}  // namespace espalier::environment
