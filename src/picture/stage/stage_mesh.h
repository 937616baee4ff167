// A frame's axes and surfaces as VTK's triangles, each of which knows the row of the frame it came from.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/archive/recorded_run.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace espalier::picture {

struct StageMesh {
    vtkSmartPointer<vtkPolyData> data;           ///< points, normals, texture coordinates and triangles
    std::vector<std::uint32_t> row_of_point;     ///< rows of `of_points`
    std::vector<std::uint32_t> row_of_triangle;  ///< rows of `of_points` for axes, of `of_cells` for surfaces
    bool is_of_axes = false;
    bool is_thin = false;       ///< seen from both sides: no axis, and no closed surface
    std::uint16_t texture = 0;  ///< the same for all of it
};

struct StageMeshOptions {
    std::optional<std::uint32_t> plant;  ///< this one alone
    std::size_t triangles = 0;           ///< most triangles of tubes, about
    double size = 1;                     ///< size of the scene: thick axes have more sides than thin ones
    float thinnest = 0.001f;             ///< radius of lines that have none, and half a pixel of those with such widths
    archive::AxisSkin skin = {};
};

/// Axes, joined where one continues another, and outlines: a mesh for each texture.
std::vector<StageMesh> tubes_of(const FrameGeometry& geometry, const StageMeshOptions& options);

/// Polygons and organs, a mesh for each texture, of what is thin and of what is closed.
std::vector<StageMesh> surfaces_of(const FrameGeometry& geometry, const StageMeshOptions& options);

std::span<const glm::vec3> points_of(const StageMesh& mesh);
std::span<const glm::vec3> normals_of(const StageMesh& mesh);
std::span<const glm::vec2> uvs_of(const StageMesh& mesh);
/// Three points a triangle.
std::span<const std::int32_t> corners_of(const StageMesh& mesh);

}  // namespace espalier::picture
