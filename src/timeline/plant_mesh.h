// The plants of a frame as points and cells, each knowing the module it shows.
#pragma once

#include "espalier/base/column.h"
#include "espalier/timeline/frame.h"
#include "espalier/timeline/kind.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace espalier {

/// Whom a point or a cell belongs to. `plant` indexes the frame's plants.
struct Owner {
    std::uint32_t plant;
    std::uint32_t module;
    std::uint16_t order;
    std::uint16_t colour;
    Kind kind;
    Look look = {};
};

/// Cells of one kind of VTK's: cell i has the points connectivity[offsets[i]] .. connectivity[offsets[i + 1] - 1].
struct Cells {
    Column<std::int32_t> offsets{0};
    Column<std::int32_t> connectivity;
    Column<Owner> owners;

    void clear();
    /// Ends the cell whose points were appended to `connectivity`.
    void close(const Owner& owner);
};

/// Reused from frame to frame: clear() keeps the memory.
struct PlantMesh {
    Column<float> points;   ///< x, y, z of one point after the other
    Column<float> normals;  ///< across the axis on axes
    Column<float> uvs;      ///< two a point
    Column<float> radii;
    Column<Owner> owners;  ///< of the points
    Cells vertices, lines, polygons;
    std::vector<std::string> labels;  ///< of the vertices of that kind, in their order

    void clear();
    /// Returns the point's number. Throws RunError beyond 2^28 points.
    std::int32_t add_point(const SurfaceVertex& vertex, double radius, const Owner& owner);
};

/// One line per axis, broken where the next internode does not begin where the last ended.
/// An axis's cell belongs to its first internode; a point to the internode that ends there, the first to the one that
/// begins there.
void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
/// Generalized cylinders and patches. A ring between two pieces belongs to the first.
void add_pieces(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_labels(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
/// The queries that are `wanted`, as vertices.
void add_queries(PlantMesh& mesh, const std::vector<Query>& queries, const std::function<bool(const Query&)>& wanted,
                 std::uint32_t plant);

}  // namespace espalier
