// The plants of a frame as points and cells, each knowing the module it shows.
#pragma once

#include "espalier/base/column.h"
#include "espalier/geometry/kind.h"
#include "espalier/geometry/palette.h"
#include "espalier/geometry/plant_geometry.h"

#include "base/rewritten_column.h"
#include "geometry/drawn/organ_mesh.h"

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace espalier::geometry {

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
class Owners {
public:
    Column<Owner> values;                 ///< owners of the runs
    RewrittenColumn<std::uint32_t> ends;  ///< ends of the runs; whole after end()

    std::size_t size() const { return size_; }
    void begin();
    void add(const Owner& owner, std::size_t count = 1) {
        if (count == 0) return;
        if (size_ == 0 || !(values.back() == owner)) {
            end();
            values.push_back(owner);
        }
        size_ += static_cast<std::uint32_t>(count);
    }
    void add(const Owners& owners);
    void end() {
        if (size_ > 0) ends.add(size_);
    }

private:
    std::uint32_t size_ = 0;
};

/// Cells of one kind of VTK's: cell i has the points from connectivity[offsets[i - 1]], the first from the beginning,
/// to before connectivity[offsets[i]].
struct Cells {
    RewrittenColumn<std::int32_t> offsets;
    RewrittenColumn<std::int32_t> connectivity;
    Owners owners;

    void begin();
    void end() { owners.end(); }
    /// Ends the cell whose points were added to `connectivity`.
    void close(const Owner& owner);
    /// Cells of points counted from `origin`.
    void add(const IndexRuns& runs, std::int32_t origin, const Owner& owner);
    /// False if they would be shown as in the frame before, but for what their owners are.
    bool changed() const { return offsets.changed() || connectivity.changed() || owners.ends.changed(); }
};

/// Written anew for every frame, between begin() and end().
class PlantMesh {
public:
    RewrittenColumn<float> points;   ///< x, y, z of one point after the other
    RewrittenColumn<float> normals;  ///< across the axis on axes
    RewrittenColumn<float> uvs;      ///< two a point
    RewrittenColumn<float> radii;
    RewrittenColumn<float> pixels;  ///< widths of lines, in pixels; empty where no plant has such widths
    Owners owners;                  ///< owners of the points
    Cells vertices, lines, polygons;
    std::vector<std::string> labels;  ///< texts of the vertices of that kind, in their order

    void begin(bool with_pixels = false);
    void end();
    std::size_t size() const { return radii.size(); }
    /// Makes room for so many points in all; there may be more.
    void reserve(std::size_t count);
    /// Adds points of one owner, `vertex(i)` being the i-th, and returns the first one's number. Throws RunError beyond
    /// 2^28 points.
    template <class Vertex>
    std::int32_t add_points(std::size_t count, const Vertex& vertex, double radius, const Owner& owner,
                            float pixel_width = 0) {
        const std::size_t first = size();
        if (count > most_points - first) refuse();
        points.add_tuples<3>(count, [&](std::size_t i, float* at) { put<3>(vertex(i).position, at); });
        normals.add_tuples<3>(count, [&](std::size_t i, float* at) { put<3>(vertex(i).normal, at); });
        uvs.add_tuples<2>(count, [&](std::size_t i, float* at) { put<2>(vertex(i).uv, at); });
        radii.add_tuples<1>(count, [&](std::size_t, float* at) { *at = static_cast<float>(radius); });
        if (with_pixels_) pixels.add_tuples<1>(count, [&](std::size_t, float* at) { *at = pixel_width; });
        owners.add(owner, count);
        return static_cast<std::int32_t>(first);
    }
    /// Returns the point's number.
    std::int32_t add_point(const SurfaceVertex& vertex, double radius, const Owner& owner, float pixel_width = 0) {
        return add_points(
            1, [&](std::size_t) -> const SurfaceVertex& { return vertex; }, radius, owner, pixel_width);
    }
    /// False if it would be shown as in the frame before, but for what its owners are.
    bool changed() const;

private:
    // A sphere's connectivity is several times its points; keep that within 31 bits too.
    static constexpr std::size_t most_points = std::numeric_limits<std::int32_t>::max() / 8;

    template <int N, class Numbers>
    static void put(const Numbers& numbers, float* at) {
        for (int k = 0; k < N; ++k) at[k] = static_cast<float>(numbers[k]);
    }
    [[noreturn]] static void refuse();

    bool with_pixels_ = false;
    std::vector<std::string> labels_before_;
};

/// Meshes of organs as they are needed, kept from frame to frame.
class OrganSource {
public:
    OrganMeshes plain;
    /// Null if there are no described surfaces.
    SurfaceMeshes* surfaces(const std::shared_ptr<const Shapes>& shapes);

private:
    std::map<std::shared_ptr<const Shapes>, SurfaceMeshes> surfaces_;
};

/// The internodes' numbers, axis after axis, in the turtle's order within each.
template <class Drawn>
std::vector<std::uint32_t> by_axis(std::span<const Drawn> internodes) {
    std::uint32_t axes = 0;
    for (const Drawn& internode : internodes) axes = std::max(axes, internode.axis + 1);
    std::vector<std::uint32_t> next(std::size_t{axes} + 1, 0);
    for (const Drawn& internode : internodes) ++next[std::size_t{internode.axis} + 1];
    for (std::size_t axis = 1; axis < next.size(); ++axis) next[axis] += next[axis - 1];
    std::vector<std::uint32_t> sorted(internodes.size());
    for (std::uint32_t i = 0; i < internodes.size(); ++i) sorted[next[internodes[i].axis]++] = i;
    return sorted;
}

/// Whether the line of one internode goes on with the next.
inline bool goes_on(const Internode& before, const Internode& next) {
    return before.axis == next.axis && before.tip == next.base;
}

/// Calls visit(number, begins) for each internode, by axis; `begins` says that it is the first of a line, because its
/// axis begins or because it does not begin where the one before has ended.
template <class Visit>
void for_lines(std::span<const Internode> internodes, const Visit& visit) {
    const Internode* last = nullptr;
    for (const std::uint32_t number : by_axis(internodes)) {
        const Internode& internode = internodes[number];
        visit(number, !last || !goes_on(*last, internode));
        last = &internode;
    }
}

/// One line per axis, broken where the next internode does not begin where the last ended.
/// An axis's cell belongs to its first internode; a point to the internode that ends there, the first to the one that
/// begins there.
void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
/// Polygons that viewers would fill otherwise are cut into triangles.
void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_organ(PlantMesh& mesh, const OrganMesh& shape, const Owner& owner);
/// `palette`: what colour indices look like, null if unknown. Patches have colours of their own where it has no
/// materials.
void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, OrganSource& source, std::uint32_t plant,
                const Palette* palette = nullptr);
/// Generalized cylinders and patches. A ring between two pieces belongs to the first.
void add_pieces(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
void add_labels(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant);
/// All of these, in this order.
void add_drawn(PlantMesh& mesh, const PlantGeometry& geometry, OrganSource& source, std::uint32_t plant,
               const Palette* palette = nullptr);

}  // namespace espalier::geometry
