// Organs as the polygons and lines a viewer can show.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <cstdint>
#include <map>
#include <vector>

namespace espalier {

/// Vertices, and faces (or one closed outline) as runs of indices into them.
struct OrganMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<std::vector<std::uint32_t>> outlines;
};

/// Discs and circles have 16 sides, or as many as a sphere if those are more, and lie across `up`, in the plane of
/// heading and left; spheres have the organ's sides as meridians, and three quarters as many bands from pole to pole
/// along the heading; a surface that nobody described shows as the rhombus it would span.
OrganMesh mesh_of(const Organ& organ);

/// The surfaces of a plant's view file, each meshed once.
class SurfaceMeshes {
public:
    explicit SurfaceMeshes(const Shapes& shapes) : shapes_(shapes) {}

    struct Entry {
        const Surface* surface;
        SurfaceMesh mesh;
        std::vector<glm::dvec2> whole;  ///< texture coordinates for one picture over the whole surface
    };
    /// Null if there is no such surface.
    const Entry* find(std::uint32_t id);
    bool textured_as_whole(const Organ& organ) const;

private:
    const Shapes& shapes_;
    std::map<std::uint32_t, Entry> entries_;
};

/// A vertex of a surface where the organ stands, stretched as the organ is.
SurfaceVertex placed(const SurfaceVertex& vertex, const Organ& organ);

}  // namespace espalier
