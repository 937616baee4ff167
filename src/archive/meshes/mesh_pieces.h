// A mesh in pieces, for programs that count vertices in 16 bits.
#pragma once

#include "archive/meshes/surface_mesh.h"

#include <limits>
#include <vector>

namespace espalier::archive {

struct PieceLimit {
    std::size_t vertices = std::numeric_limits<std::size_t>::max();
    std::size_t triangles = std::numeric_limits<std::size_t>::max();
};

/// Parts in their order, as many as a piece may hold; only a part that is larger than a piece is cut, between its
/// triangles. All triangles of the whole, each once; materials keep their numbers. Three vertices and one triangle are
/// the least limit.
std::vector<FrameMesh> pieces_of(const FrameMesh& mesh, const PieceLimit& limit);

}  // namespace espalier::archive
