// Coarser versions of an organ, whose vertices are some of its own.
#pragma once

#include "archive/meshes/surface_mesh.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace espalier::archive {

struct OrganLevel {
    double error;  ///< how far the surface strays, as a share of the organ's size
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counted from the organ's first vertex
};

/// The largest distance of an organ's vertices from its first.
double organ_size(const FrameMesh& mesh, const MeshPart& organ);

/// Computes each shape once, wherever and however large it stands.
class OrganLevels {
public:
    /// The coarser the later; none for cards and for organs of several materials.
    const std::vector<OrganLevel>& of(const FrameMesh& mesh, const MeshPart& organ);

private:
    using Key = std::vector<std::uint32_t>;

    std::map<Key, std::vector<OrganLevel>> levels_;
};

}  // namespace espalier::archive
