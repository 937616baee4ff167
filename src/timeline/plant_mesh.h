// The plants of a frame as points and cells, each knowing the module it shows.
#pragma once

#include "espalier/base/column.h"
#include "espalier/timeline/frame.h"
#include "espalier/timeline/kind.h"

#include "timeline/organ_mesh.h"

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier {

/// Also of numbers that are none.
template <class T>
bool same_bytes(const Column<T>& a, const Column<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Whom a point or a cell belongs to. `plant` indexes the frame's plants.
struct Owner {
    std::uint32_t plant;
    std::uint32_t module;
    std::uint16_t order;
    std::uint16_t colour;
    Kind kind;
    Look look = {};

    bool operator==(const Owner& other) const {
        return module == other.module && plant == other.plant && order == other.order && colour == other.colour &&
               kind == other.kind && look.back_colour == other.look.back_colour && look.texture == other.look.texture;
    }
};

/// The owners of points or cells in their order; neighbours mostly have the same one, so they are kept as runs.
struct Owners {
    Column<Owner> values;
    Column<std::uint32_t> ends;  ///< of the runs

    std::size_t size() const { return ends.empty() ? 0 : ends.back(); }
    void clear();
    void add(const Owner& owner, std::size_t count = 1) {
        if (count == 0) return;
        const auto end = static_cast<std::uint32_t>(size() + count);
        if (!values.empty() && values.back() == owner) {
            ends.back() = end;
        } else {
            values.push_back(owner);
            ends.push_back(end);
        }
    }
    void add(const Owners& owners);
};

/// Cells of one kind of VTK's: cell i has the points connectivity[offsets[i]] .. connectivity[offsets[i + 1] - 1].
struct Cells {
    Column<std::int32_t> offsets{0};
    Column<std::int32_t> connectivity;
    Owners owners;

    void clear();
    /// Ends the cell whose points were appended to `connectivity`.
    void close(const Owner& owner);
    /// Cells of points counted from `origin`.
    void add(const IndexRuns& runs, std::int32_t origin, const Owner& owner);
};

/// Reused from frame to frame: clear() keeps the memory. Columns of points are longer than needed until trim().
struct PlantMesh {
    Column<float> points;   ///< x, y, z of one point after the other
    Column<float> normals;  ///< across the axis on axes
    Column<float> uvs;      ///< two a point
    Column<float> radii;
    Owners owners;                ///< of the points
    Column<std::uint32_t> parts;  ///< where points that were added together end
    Cells vertices, lines, polygons;
    std::vector<std::string> labels;  ///< of the vertices of that kind, in their order

    void clear();
    std::size_t size() const { return size_; }
    /// Makes room for points of one owner, returns the first one's number. Throws RunError beyond 2^28 points.
    std::int32_t add_points(std::size_t count, const Owner& owner) {
        const std::size_t first = size_;
        if (count > radii.size() - first) make_room(count);
        size_ = first + count;
        owners.add(owner, count);
        if (count > 0) parts.push_back(static_cast<std::uint32_t>(size_));
        return static_cast<std::int32_t>(first);
    }
    void set_point(std::size_t point, const SurfaceVertex& vertex, double radius) {
        float* const at = points.data() + 3 * point;
        float* const normal = normals.data() + 3 * point;
        float* const uv = uvs.data() + 2 * point;
        for (int k = 0; k < 3; ++k) at[k] = static_cast<float>(vertex.position[k]);
        for (int k = 0; k < 3; ++k) normal[k] = static_cast<float>(vertex.normal[k]);
        for (int k = 0; k < 2; ++k) uv[k] = static_cast<float>(vertex.uv[k]);
        radii[point] = static_cast<float>(radius);
    }
    /// Returns the point's number.
    std::int32_t add_point(const SurfaceVertex& vertex, double radius, const Owner& owner) {
        const std::int32_t point = add_points(1, owner);
        set_point(static_cast<std::size_t>(point), vertex, radius);
        return point;
    }
    /// Makes room for so many points in all; there may be more.
    void reserve(std::size_t count);
    void trim();
    /// True if both would be shown the same but for what their owners are.
    bool same_shape(const PlantMesh& other) const;

private:
    void make_room(std::size_t count);
    void resize(std::size_t count);

    std::size_t size_ = 0;
};

/// Meshes of organs as they are needed, kept from frame to frame.
class OrganSource {
public:
    OrganMeshes plain;
    /// Null if nobody described surfaces.
    SurfaceMeshes* surfaces(const std::shared_ptr<const Shapes>& shapes);

private:
    std::map<std::shared_ptr<const Shapes>, SurfaceMeshes> surfaces_;
};

/// One line per axis, broken where the next internode does not begin where the last ended.
/// An axis's cell belongs to its first internode; a point to the internode that ends there, the first to the one that
/// begins there.
void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, OrganSource& source, std::uint32_t plant);
/// Generalized cylinders and patches. A ring between two pieces belongs to the first.
void add_pieces(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_labels(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
/// The queries that are `wanted`, as vertices.
void add_queries(PlantMesh& mesh, std::span<const Query> queries, const std::function<bool(const Query&)>& wanted,
                 std::uint32_t plant);

}  // namespace espalier
