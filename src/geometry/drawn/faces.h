// The faces of drawn plants as light meets them: leaves, stems and bodies, with their modules and materials.
#pragma once

#include "espalier/geometry/kind.h"
#include "espalier/geometry/palette.h"
#include "espalier/geometry/plant_geometry.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace espalier::geometry {

/// Light meets leaves on both sides, and stems (internodes, closed cylinders) and bodies (spheres) on their outside.
enum class FaceOf : std::uint8_t { leaf, stem, body };

/// Whose a face is, and what it is made of. Colours are indices into the plant's palette.
struct FaceOwner {
    std::uint32_t plant;
    std::uint32_t module;  ///< index of the module in the plant's string, which knows its identity
    Kind kind;
    std::uint16_t colour, back_colour;
    std::uint16_t texture;  ///< counted from 1 in Shapes::textures; 0: none
    FaceOf of = FaceOf::leaf;
};

/// A polygon. Its front is the side from which the corners run counter-clockwise; stems and bodies have it outside.
struct DrawnFace {
    const FaceOwner& owner;
    std::span<const glm::dvec3> corners;  ///< metres, of the world

    /// Newell's normal, as long as the area: it points away from the front.
    glm::dvec3 area() const;
    glm::dvec3 middle() const;
    /// Calls visit(a, b, c) with the corners of each triangle: a fan around the first corner.
    template <class Visit>
    void for_triangles(const Visit& visit) const {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) visit(corners[0], corners[i], corners[i + 1]);
    }
};

class OrganMeshes;
class WornPictures;

/// Faces one after the other. The one place where light takes what a turtle has drawn. A face that wears a picture with
/// holes is drawn in about its middle until its area is the share of it that the picture leaves opaque, so that light
/// meets as much of a card as there are leaves on it; one that shows nothing is left out.
class DrawnFaces {
public:
    void clear();
    /// Adds all that a plant has drawn flat, in this order: its polygons, the triangles of its patches and of its
    /// cylinders with open contours, the faces of its surfaces, and its discs as squares of their area. A surface that
    /// no view file describes is the rhombus that pictures show. Where the palette is known, patches have the colours
    /// that `colours_of_patch` gives them, else those of their organs.
    void add_leaves(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette = nullptr);
    /// Adds each internode as an open prism of twelve triangles with the surface of the cone; those without length or
    /// radius have none.
    void add_stems(std::uint32_t plant, const PlantGeometry& geometry);
    /// Adds the triangles of closed cylinders, and spheres as polyhedra with the surface of the sphere. From all
    /// directions together, those look as large as it (Cauchy 1841): a quarter of the surface.
    void add_bodies(std::uint32_t plant, const PlantGeometry& geometry);

    std::size_t size() const { return owners_.size(); }
    DrawnFace operator[](std::size_t i) const {
        return {owners_[i], std::span(corners_).subspan(ends_[i], ends_[i + 1] - ends_[i])};
    }

private:
    void add(const FaceOwner& owner, std::span<const glm::dvec3> corners, double opaque = 1);
    void add_piece(const FaceOwner& owner, const DrawnMesh& mesh, const MeshPiece& piece, WornPictures& pictures);
    void add_organs(std::uint32_t plant, const PlantGeometry& geometry, const Palette* palette, WornPictures& pictures);
    void add_stem(const FaceOwner& owner, const Internode& internode);
    void add_sphere(std::uint32_t plant, const Organ& organ, OrganMeshes& meshes);

    std::vector<FaceOwner> owners_;
    std::vector<std::size_t> ends_{0};
    std::vector<glm::dvec3> corners_;
};

}  // namespace espalier::geometry
