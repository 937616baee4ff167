// Organs as the polygons and lines a viewer can show.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <cstdint>
#include <vector>

namespace espalier {

/// Points, and faces (or one closed outline) as runs of indices into them.
struct OrganMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<std::vector<std::uint32_t>> outlines;
};

/// Discs and circles have 16 sides and lie across `up`, in the plane of heading and left; spheres have 8 meridians
/// and 6 bands from pole to pole along the heading; a surface shows as the rhombus it would span.
OrganMesh mesh_of(const Organ& organ);

}  // namespace espalier
