#include "geometry/drawn/plant_mesh.h"

#include "espalier/base/error.h"

#include "geometry/polygon_texture.h"
#include "geometry/polygon_triangles.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace espalier::geometry {
namespace {

/// A vector across a line, carried from segment to segment so that it turns no more than it must.
class AcrossLine {
public:
    void begin() { across_ = {0, 0, 0}; }
    glm::dvec3 after(const glm::dvec3& direction) {
        const double square = glm::dot(direction, direction);
        if (square > 0) across_ -= direction * (glm::dot(across_, direction) / square);
        const double length = glm::length(across_);
        if (length > 1e-6) return across_ /= length;
        const glm::dvec3 other =
            std::abs(direction.z) < 0.9 * std::sqrt(square) ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        across_ = other - direction * (square > 0 ? glm::dot(other, direction) / square : 0);
        return across_ = glm::normalize(across_);
    }

private:
    glm::dvec3 across_{0, 0, 0};
};

/// The normal of a polygon by Newell's method, which no vertex in line with its neighbours disturbs.
glm::dvec3 normal_of(const glm::dvec3* vertices, std::uint32_t count) {
    return unit_or(geometry::area_vector(count, [&](std::size_t i) { return vertices[i]; }), {0, 0, 1});
}

}  // namespace

void Owners::begin() {
    values.clear();
    ends.begin();
    size_ = 0;
}

void Owners::add(const Owners& owners) {
    std::uint32_t begin = 0;
    const std::span<const std::uint32_t> run_ends = owners.ends.values();
    for (std::size_t run = 0; run < run_ends.size(); ++run) {
        add(owners.values[run], run_ends[run] - begin);
        begin = run_ends[run];
    }
}

void Cells::begin() {
    offsets.begin();
    connectivity.begin();
    owners.begin();
}

void Cells::close(const Owner& owner) {
    offsets.add(static_cast<std::int32_t>(connectivity.size()));
    owners.add(owner);
}

void Cells::add(const IndexRuns& runs, std::int32_t origin, const Owner& owner) {
    if (runs.counts.empty()) return;
    auto end = static_cast<std::int32_t>(connectivity.size());
    connectivity.add_tuples<1>(runs.indices.size(), [&](std::size_t i, std::int32_t* corner) {
        *corner = origin + static_cast<std::int32_t>(runs.indices[i]);
    });
    for (const std::uint32_t count : runs.counts) offsets.add(end += static_cast<std::int32_t>(count));
    owners.add(owner, runs.counts.size());
}

void PlantMesh::begin(bool with_pixels) {
    with_pixels_ = with_pixels;
    for (RewrittenColumn<float>* column : {&points, &normals, &uvs, &radii, &pixels}) column->begin();
    owners.begin();
    for (Cells* cells : {&vertices, &lines, &polygons}) cells->begin();
    labels_before_.swap(labels);
    labels.clear();
}

void PlantMesh::end() {
    owners.end();
    for (Cells* cells : {&vertices, &lines, &polygons}) cells->end();
}

void PlantMesh::reserve(std::size_t count) {
    count = std::min(count, most_points);
    points.reserve(3 * count);
    normals.reserve(3 * count);
    uvs.reserve(2 * count);
    radii.reserve(count);
}

void PlantMesh::refuse() {
    throw RunError("a frame of the timeline would have more than 268 million points");
}

bool PlantMesh::changed() const {
    return points.changed() || normals.changed() || uvs.changed() || radii.changed() || pixels.changed() ||
           owners.ends.changed() || vertices.changed() || lines.changed() || polygons.changed() ||
           labels != labels_before_;
}

SurfaceMeshes* OrganSource::surfaces(const std::shared_ptr<const Shapes>& shapes) {
    if (!shapes) return nullptr;
    return &surfaces_.try_emplace(shapes, shapes).first->second;
}

void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    std::optional<Owner> line;
    AcrossLine across;
    for_lines(geometry.internodes, [&](std::uint32_t i, bool begins) {
        const Internode& internode = geometry.internodes[i];
        const std::uint16_t texture = i < geometry.textures.size() ? geometry.textures[i] : std::uint16_t{0};
        const Owner owner{plant,      internode.module,           internode.order, internode.colour,
                          Kind::axis, {internode.colour, texture}};
        if (begins) across.begin();
        const glm::dvec3 normal = across.after(internode.tip - internode.base);
        if (begins) {
            if (line) mesh.lines.close(*line);
            line = owner;
            mesh.lines.connectivity.add(
                mesh.add_point({internode.base, normal, {}}, internode.base_radius, owner, internode.pixels));
        }
        mesh.lines.connectivity.add(
            mesh.add_point({internode.tip, normal, {}}, internode.tip_radius, owner, internode.pixels));
    });
    if (line) mesh.lines.close(*line);
}

void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Polygon& polygon : geometry.polygons) {
        const Owner owner{plant, polygon.module, polygon.order, polygon.colour, Kind::polygon, polygon.look};
        const glm::dvec3* vertices = &geometry.vertices[polygon.first];
        const glm::dvec3 normal = normal_of(vertices, polygon.count);
        const std::vector<glm::dvec2> uvs = texture_coordinates({vertices, polygon.count}, normal);
        const auto vertex = [&](std::size_t i) { return SurfaceVertex{vertices[i], normal, uvs[i]}; };
        const std::int32_t origin = mesh.add_points(polygon.count, vertex, 0, owner);
        const std::vector<std::uint32_t> triangles = triangles_of({vertices, polygon.count}, normal);
        const std::size_t corners = triangles.empty() ? polygon.count : triangles.size();
        for (std::uint32_t i = 0; i < corners; ++i) {
            const std::uint32_t corner = triangles.empty() ? i : triangles[i];
            mesh.polygons.connectivity.add(origin + static_cast<std::int32_t>(corner));
            if (i + 1 == corners || (!triangles.empty() && i % 3 == 2)) mesh.polygons.close(owner);
        }
    }
}

void add_organ(PlantMesh& mesh, const OrganMesh& shape, const Owner& owner) {
    const auto vertex = [&shape](std::size_t i) -> const SurfaceVertex& { return shape.vertices[i]; };
    const std::int32_t origin = mesh.add_points(shape.vertices.size(), vertex, 0, owner);
    mesh.lines.add(shape.outlines, origin, owner);
    mesh.polygons.add(shape.faces, origin, owner);
}

namespace {

Owner owner_of_patch(Owner owner, const BicubicPatch* patch, const Palette* palette) {
    const SideColours colours = colours_of_patch({owner.colour, owner.look.back_colour}, patch, palette);
    owner.colour = colours.front;
    owner.look.back_colour = colours.back;
    return owner;
}

void add_surface(PlantMesh& mesh, const SurfaceMeshes::Entry& entry, const Organ& organ, bool as_whole,
                 const Owner& owner, const Palette* palette) {
    const SurfaceMesh& shape = entry.mesh;
    const auto origin = static_cast<std::int32_t>(mesh.size());
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        SurfaceVertex vertex = placed(shape.vertices[i], organ);
        if (as_whole) vertex.uv = entry.whole[i];
        mesh.add_point(vertex, 0, owner_of_patch(owner, entry.patches[i], palette));
    }
    std::size_t at = 0;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        for (std::size_t k = 0; k < shape.faces[face]; ++k) {
            mesh.polygons.connectivity.add(origin + static_cast<std::int32_t>(shape.indices[at++]));
        }
        mesh.polygons.close(owner_of_patch(owner, entry.patch(face), palette));
    }
}

}  // namespace

void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, OrganSource& source, std::uint32_t plant,
                const Palette* palette) {
    SurfaceMeshes* const surfaces = source.surfaces(geometry.shapes);
    for (const Organ& organ : geometry.organs) {
        const Owner owner{plant, organ.module, organ.order, organ.colour, Kind::organ, organ.look};
        const SurfaceMeshes::Entry* surface =
            surfaces && organ.shape == Organ::Shape::surface ? surfaces->find(organ.surface) : nullptr;
        if (surface) {
            add_surface(mesh, *surface, organ, surfaces->textured_as_whole(organ), owner, palette);
        } else {
            add_organ(mesh, source.plain.of(organ), owner);
        }
    }
}

void add_pieces(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    const DrawnMesh& drawn = geometry.mesh;
    std::vector<std::int32_t> point_of(drawn.vertices.size(), -1);
    for (const MeshPiece& piece : drawn.pieces) {
        const Kind kind = piece.kind == MeshPiece::Kind::cylinder ? Kind::cylinder : Kind::patch;
        const Owner owner{plant, piece.module, piece.order, piece.colour, kind, piece.look};
        for (std::uint32_t i = 0; i < piece.count; ++i) {
            const std::uint32_t vertex = drawn.triangles[piece.first + i];
            if (point_of[vertex] < 0) point_of[vertex] = mesh.add_point(drawn.vertices[vertex], 0, owner);
            mesh.polygons.connectivity.add(point_of[vertex]);
            if (i % 3 == 2) mesh.polygons.close(owner);
        }
    }
}

void add_labels(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Label& label : geometry.labels) {
        const Owner owner{plant, label.module, label.order, label.colour, Kind::label};
        mesh.vertices.connectivity.add(mesh.add_point({label.position, {0, 0, 1}, {}}, 0, owner));
        mesh.vertices.close(owner);
        mesh.labels.push_back(label.text);
    }
}

void add_drawn(PlantMesh& mesh, const PlantGeometry& geometry, OrganSource& source, std::uint32_t plant,
               const Palette* palette) {
    add_axes(mesh, geometry, plant);
    add_polygons(mesh, geometry, plant);
    add_organs(mesh, geometry, source, plant, palette);
    add_pieces(mesh, geometry, plant);
    add_labels(mesh, geometry, plant);
}

}  // namespace espalier::geometry
