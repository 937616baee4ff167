#include "timeline/plant_mesh.h"

#include "espalier/base/error.h"

#include "timeline/organ_mesh.h"

#include <algorithm>
#include <limits>

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
    radii.clear();
    owners.clear();
    vertices.clear();
    lines.clear();
    polygons.clear();
}

std::int32_t PlantMesh::add_point(const glm::dvec3& position, double radius, const Owner& owner) {
    // A sphere's connectivity is several times its points; keep that within 31 bits too.
    if (owners.size() >= std::numeric_limits<std::int32_t>::max() / 8) {
        throw RunError("a frame of the timeline would have more than 268 million points");
    }
    points.push_back(static_cast<float>(position.x));
    points.push_back(static_cast<float>(position.y));
    points.push_back(static_cast<float>(position.z));
    radii.push_back(static_cast<float>(radius));
    owners.push_back(owner);
    return static_cast<std::int32_t>(owners.size() - 1);
}

void add_axes(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    const Internode* last = nullptr;
    Owner first{};
    for (const std::uint32_t i : by_axis(geometry.internodes)) {
        const Internode& internode = geometry.internodes[i];
        const Owner owner{plant, internode.module, internode.order, internode.colour, Kind::axis};
        if (!last || !continues(*last, internode)) {
            if (last) mesh.lines.close(first);
            first = owner;
            mesh.lines.connectivity.push_back(mesh.add_point(internode.base, internode.base_radius, owner));
        }
        mesh.lines.connectivity.push_back(mesh.add_point(internode.tip, internode.tip_radius, owner));
        last = &internode;
    }
    if (last) mesh.lines.close(first);
}

void add_polygons(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Polygon& polygon : geometry.polygons) {
        const Owner owner{plant, polygon.module, polygon.order, polygon.colour, Kind::polygon};
        for (std::uint32_t i = 0; i < polygon.count; ++i) {
            mesh.polygons.connectivity.push_back(mesh.add_point(geometry.vertices[polygon.first + i], 0, owner));
        }
        mesh.polygons.close(owner);
    }
}

void add_organs(PlantMesh& mesh, const PlantGeometry& geometry, std::uint32_t plant) {
    for (const Organ& organ : geometry.organs) {
        const Owner owner{plant, organ.module, organ.order, organ.colour, Kind::organ};
        const OrganMesh shape = mesh_of(organ);
        const auto origin = static_cast<std::int32_t>(mesh.owners.size());
        for (const glm::dvec3& point : shape.points) mesh.add_point(point, 0, owner);
        const auto add_cells = [&](Cells& cells, const std::vector<std::vector<std::uint32_t>>& runs) {
            for (const auto& run : runs) {
                for (const std::uint32_t i : run) cells.connectivity.push_back(origin + static_cast<std::int32_t>(i));
                cells.close(owner);
            }
        };
        add_cells(mesh.lines, shape.outlines);
        add_cells(mesh.polygons, shape.faces);
    }
}

void add_queries(PlantMesh& mesh, const std::vector<Query>& queries, const std::function<bool(const Query&)>& wanted,
                 std::uint32_t plant) {
    for (const Query& query : queries) {
        if (!wanted(query)) continue;
        const Owner owner{plant, query.module, 0, 0, Kind::query};
        mesh.vertices.connectivity.push_back(mesh.add_point(query.pose.position, query.width / 2, owner));
        mesh.vertices.close(owner);
    }
}

}  // namespace espalier
