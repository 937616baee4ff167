// Surfaces an organ can have: bicubic patches, or triangles.
#pragma once

#include "espalier/base/stations.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::geometry {

/// Sixteen control points. s runs from row to row, t from column to column, both in [0, 1].
struct BicubicPatch {
    enum class Basis : std::uint8_t { bezier = 1, b_spline = 2, cardinal = 3 };
    /// The eight patches around it whose edges are smoothed with its own, in this order; -1 if none.
    enum Neighbour { above_left, above, above_right, left, right, below_left, below, below_right };

    std::array<std::array<glm::dvec3, 4>, 4> points{};  ///< [row][column]
    Basis basis = Basis::bezier;
    std::string name;
    std::array<int, 8> neighbours{-1, -1, -1, -1, -1, -1, -1, -1};
    int top_colour = 0, bottom_colour = 0;  ///< colour index; 0: the turtle's
    double top_diffuse = 0, bottom_diffuse = 0;
};

struct SurfaceVertex {
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 normal{0, 0, 0};  ///< unit length; pointing out where there is an outside
    glm::dvec2 uv{0, 0};
};

/// A surface in the turtle's frame: x along left, y along heading, z along up, lengths in the unit of the model,
/// the contact point at the origin.
struct Surface {
    std::vector<BicubicPatch> patches;
    std::vector<std::array<SurfaceVertex, 3>> triangles;  ///< instead of patches
    glm::dvec3 end{0, 0, 0};                              ///< where the turtle goes on after it
    int precision_s = 5, precision_t = 5;                 ///< quadrilaterals along each side of a patch
    std::optional<int> texture;                           ///< none: the turtle's; 0: no texture
};

/// A point of a patch and its unit normal, d/ds x d/dt. `uv` is (s, t).
SurfaceVertex evaluate(const BicubicPatch& patch, double s, double t);

/// Points shared within a patch, faces as triangles or quadrilaterals, normals averaged along common edges.
struct SurfaceMesh {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;  ///< vertices of all faces, one face after the other
    std::vector<std::uint32_t> faces;    ///< number of vertices of each face
    std::vector<std::uint32_t> patches;  ///< the patch each face belongs to; none of a surface of triangles
};
SurfaceMesh mesh_of(const Surface& surface);

}  // namespace espalier::geometry
