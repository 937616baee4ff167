#include "timeline/plant_mesh.h"

#include "espalier/base/error.h"

#include "timeline/organ_mesh.h"
#include "timeline/polygon_triangles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace espalier {
namespace {

// The internodes' numbers, axis after axis, in the turtle's order within each.
std::vector<std::uint32_t> by_axis(const std::vector<Internode>& internodes) {
    std::uint32_t axes = 0;
    for (const Internode& internode : internodes) axes = std::max(axes, internode.axis + 1);
    std::vector<std::uint32_t> next(std::size_t{axes} + 1, 0);
    for (const Internode& internode : internodes) ++next[std::size_t{internode.axis} + 1];
    for (std::size_t axis = 1; axis < next.size(); ++axis) next[axis] += next[axis - 1];
    std::vector<std::uint32_t> sorted(internodes.size());
    for (std::uint32_t i = 0; i < internodes.size(); ++i) sorted[next[internodes[i].axis]++] = i;
    return sorted;
}

bool continues(const Internode& before, const Internode& after) {
    return before.axis == after.axis && before.tip == after.base;
}

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
    glm::dvec3 sum(0);
    for (std::uint32_t i = 0; i < count; ++i) {
        sum += glm::cross(vertices[i] - vertices[0], vertices[(i + 1) % count] - vertices[0]);
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0, 0, 1);
}

}  // namespace

void Cells::clear() {
    offsets.assign(1, 0);
    connectivity.clear();
    owners.clear();
}

void Cells::close(const Owner& owner) {
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    owners.push_back(owner);
}

void PlantMesh::clear() {
    points.clear();
    normals.clear();
    uvs.clear();
    labels.clear();
    radii.clear();
    owners.clear();
    vertices.clear();
    lines.clear();
    polygons.clear();
}

std::int32_t PlantMesh::add_point(const SurfaceVertex& vertex, double radius, const Owner& owner) {
    // A sphere's connectivity is several times its points; keep that within 31 bits too.
    if (owners.size() >= std::numeric_limits<std::int32_t>::max() / 8) {
        throw RunError("a frame of the timeline would have more than 268 million points");
    }
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(vertex.position[k]));
    for (int k = 0; k < 3; ++k) normals.push_back(static_cast<float>(vertex.normal[k]));
    for (int k = 0; k < 2; ++k) uvs.push_back(static_cast<float>(vertex.uv[k]));
    radii.push_back(static_cast<float>(radius));
    owners.push_back(owner);
    return static_cast<std::int32_t>(owners.size() - 1);
}

void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    const Internode* last = nullptr;
    Owner first{};
    AcrossLine across;
    for (const std::uint32_t i : by_axis(geometry.internodes)) {
        const Internode& internode = geometry.internodes[i];
        const std::uint16_t texture = i < geometry.textures.size() ? geometry.textures[i] : std::uint16_t{0};
        const Owner owner{plant,      internode.module,           internode.order, internode.colour,
                          Kind::axis, {internode.colour, texture}};
        const bool begins = !last || !continues(*last, internode);
        if (begins) across.begin();
        const glm::dvec3 normal = across.after(internode.tip - internode.base);
        if (begins) {
            if (last) mesh.lines.close(first);
            first = owner;
            mesh.lines.connectivity.push_back(
                mesh.add_point({internode.base, normal, {}}, internode.base_radius, owner));
        }
        mesh.lines.connectivity.push_back(mesh.add_point({internode.tip, normal, {}}, internode.tip_radius, owner));
        last = &internode;
    }
    if (last) mesh.lines.close(first);
}

void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Polygon& polygon : geometry.polygons) {
        const Owner owner{plant, polygon.module, polygon.order, polygon.colour, Kind::polygon, polygon.look};
        const glm::dvec3* vertices = &geometry.vertices[polygon.first];
        const glm::dvec3 normal = normal_of(vertices, polygon.count);
        const auto origin = static_cast<std::int32_t>(mesh.owners.size());
        for (std::uint32_t i = 0; i < polygon.count; ++i) mesh.add_point({vertices[i], normal, {}}, 0, owner);
        const std::vector<std::uint32_t> triangles = triangles_of({vertices, polygon.count}, normal);
        const std::size_t corners = triangles.empty() ? polygon.count : triangles.size();
        for (std::uint32_t i = 0; i < corners; ++i) {
            const std::uint32_t corner = triangles.empty() ? i : triangles[i];
            mesh.polygons.connectivity.push_back(origin + static_cast<std::int32_t>(corner));
            if (i + 1 == corners || (!triangles.empty() && i % 3 == 2)) mesh.polygons.close(owner);
        }
    }
}

namespace {

void add_organ(PlantMesh& mesh, const OrganMesh& shape, const Owner& owner) {
    const auto origin = static_cast<std::int32_t>(mesh.owners.size());
    for (const SurfaceVertex& vertex : shape.vertices) mesh.add_point(vertex, 0, owner);
    const auto add_cells = [&](Cells& cells, const std::vector<std::vector<std::uint32_t>>& runs) {
        for (const auto& run : runs) {
            for (const std::uint32_t i : run) cells.connectivity.push_back(origin + static_cast<std::int32_t>(i));
            cells.close(owner);
        }
    };
    add_cells(mesh.lines, shape.outlines);
    add_cells(mesh.polygons, shape.faces);
}

/// Patches may have colours of their own, on both sides.
Owner owner_of_patch(Owner owner, const Surface& surface, const SurfaceMesh& shape, std::size_t face) {
    if (face >= shape.patches.size()) return owner;
    const BicubicPatch& patch = surface.patches[shape.patches[face]];
    if (patch.top_colour > 0) owner.colour = static_cast<std::uint16_t>(patch.top_colour);
    if (patch.bottom_colour > 0) owner.look.back_colour = static_cast<std::uint16_t>(patch.bottom_colour);
    return owner;
}

void add_surface(PlantMesh& mesh, const SurfaceMeshes::Entry& entry, const Organ& organ, bool as_whole, Owner owner) {
    const SurfaceMesh& shape = entry.mesh;
    const auto origin = static_cast<std::int32_t>(mesh.owners.size());
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
        SurfaceVertex vertex = placed(shape.vertices[i], organ);
        if (as_whole) vertex.uv = entry.whole[i];
        mesh.add_point(vertex, 0, owner);
    }
    std::size_t at = 0;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const Owner of_face = owner_of_patch(owner, *entry.surface, shape, face);
        const std::size_t count = shape.faces[face];
        for (std::size_t k = 0; k < count; ++k) {
            const auto point = origin + static_cast<std::int32_t>(shape.indices[at + k]);
            mesh.polygons.connectivity.push_back(point);
            mesh.owners[static_cast<std::size_t>(point)] = of_face;
        }
        mesh.polygons.close(of_face);
        at += count;
    }
}

}  // namespace

void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    std::optional<SurfaceMeshes> surfaces;
    if (geometry.shapes) surfaces.emplace(*geometry.shapes);
    for (const Organ& organ : geometry.organs) {
        const Owner owner{plant, organ.module, organ.order, organ.colour, Kind::organ, organ.look};
        const SurfaceMeshes::Entry* surface =
            surfaces && organ.shape == Organ::Shape::surface ? surfaces->find(organ.surface) : nullptr;
        if (surface) {
            add_surface(mesh, *surface, organ, surfaces->textured_as_whole(organ), owner);
        } else {
            add_organ(mesh, mesh_of(organ), owner);
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
            mesh.polygons.connectivity.push_back(point_of[vertex]);
            if (i % 3 == 2) mesh.polygons.close(owner);
        }
    }
}

void add_labels(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Label& label : geometry.labels) {
        const Owner owner{plant, label.module, label.order, label.colour, Kind::label};
        mesh.vertices.connectivity.push_back(mesh.add_point({label.position, {0, 0, 1}, {}}, 0, owner));
        mesh.vertices.close(owner);
        mesh.labels.push_back(label.text);
    }
}

void add_queries(PlantMesh& mesh, const std::vector<Query>& queries, const std::function<bool(const Query&)>& wanted,
                 std::uint32_t plant) {
    for (const Query& query : queries) {
        if (!wanted(query)) continue;
        const Owner owner{plant, query.module, 0, 0, Kind::query};
        const SurfaceVertex vertex{query.pose.position, {0, 0, 1}, {}};
        mesh.vertices.connectivity.push_back(mesh.add_point(vertex, query.width / 2, owner));
        mesh.vertices.close(owner);
    }
}

}  // namespace espalier
