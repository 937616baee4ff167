// Organs as the polygons and lines a viewer can show.
#pragma once

#include "espalier/geometry/palette.h"
#include "espalier/geometry/plant_geometry.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace espalier::geometry {

/// Runs of indices into vertices: the faces of a mesh, or its outlines.
struct IndexRuns {
    std::vector<std::uint32_t> counts;
    std::vector<std::uint32_t> indices;

    void add(const std::vector<std::uint32_t>& run);
};

struct OrganMesh {
    std::vector<SurfaceVertex> vertices;
    IndexRuns faces, outlines;
};

/// Meshes of organs that no view file describes; the angles and faces of a shape are worked out once.
/// Discs and circles have 16 sides, or as many as a sphere if those are more, and lie across `up`, in the plane of
/// heading and left; spheres have the organ's sides as meridians, and three quarters as many bands from pole to pole
/// along the heading; a surface shows as the rhombus it would span.
class OrganMeshes {
public:
    /// Valid until the next.
    const OrganMesh& of(const Organ& organ);

private:
    struct Round {
        OrganMesh mesh;
        std::vector<glm::dvec4> angles;  ///< cosines and sines of the vertices
    };

    const OrganMesh& disc(const Organ& organ);
    const OrganMesh& circle(const Organ& organ);
    const OrganMesh& sphere(const Organ& organ);
    const OrganMesh& rhombus(const Organ& organ);

    std::map<std::uint32_t, Round> discs_, circles_, spheres_;  ///< by sides
    OrganMesh rhombus_;
};

/// The surfaces of a plant's view file, each meshed once.
class SurfaceMeshes {
public:
    explicit SurfaceMeshes(std::shared_ptr<const Shapes> shapes) : shapes_(std::move(shapes)) {}

    struct Entry {
        const Surface* surface;
        SurfaceMesh mesh;
        std::vector<glm::dvec2> whole;             ///< texture coordinates for one picture over the whole surface
        std::vector<const BicubicPatch*> patches;  ///< patch of each vertex, that of the last face with it; null: none

        /// The patch of a face; null for a surface of triangles.
        const BicubicPatch* patch(std::size_t face) const {
            return face < mesh.patches.size() ? &surface->patches[mesh.patches[face]] : nullptr;
        }
    };
    /// Null if there is no such surface.
    const Entry* find(std::uint32_t id);
    bool textured_as_whole(const Organ& organ) const;

private:
    std::shared_ptr<const Shapes> shapes_;
    std::map<std::uint32_t, Entry> entries_;
};

/// Colour indices of the two sides of something flat.
struct SideColours {
    std::uint16_t front, back;
};

/// The colours of an organ where its surface has this patch, which may be null. Patches may have colours of their own;
/// where `palette` has materials they have none, as in cpfg.
SideColours colours_of_patch(SideColours organ, const BicubicPatch* patch, const Palette* palette);

/// The corners of what stands for a surface that no view file describes, from the foot around.
std::array<glm::dvec3, 4> rhombus_of(const Organ& organ);

/// A vertex of a surface where the organ stands, stretched as the organ is.
SurfaceVertex placed(const SurfaceVertex& vertex, const Organ& organ);

}  // namespace espalier::geometry
