#include "archive/meshes/organ_levels.h"

namespace espalier::archive {

double organ_size(const FrameMesh&, const MeshPart&) {
    return 0;
}

/// None: they are VTK's.
const std::vector<OrganLevel>& OrganLevels::of(const FrameMesh&, const MeshPart&) {
    static const std::vector<OrganLevel> none;
    return none;
}

}  // namespace espalier::archive
