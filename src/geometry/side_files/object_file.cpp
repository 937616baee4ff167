// Wavefront OBJ as the shape of an organ.
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "geometry/polygon_triangles.h"
#include "geometry/side_files/obj_mesh.h"
#include "geometry/side_files/side_files.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cstdint>
#include <span>

namespace espalier::geometry {
namespace {

// As the file has x, y and z: at the origin of a plant, an organ stands as it was modelled.
glm::dvec3 in_turtle_frame(const glm::dvec3& v) {
    return {-v.x, v.y, -v.z};
}

std::array<SurfaceVertex, 3> triangle_of(const ObjMesh& mesh, const std::array<ObjMesh::Corner, 3>& corners,
                                         double size) {
    const auto place = [&](std::size_t k) { return mesh.positions[corners[k].position]; };
    const glm::dvec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
    std::array<SurfaceVertex, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 normal = corners[k].normal ? mesh.normals[*corners[k].normal] : across;
        triangle[k].position = size * in_turtle_frame(place(k));
        triangle[k].normal = glm::length(normal) > 0 ? in_turtle_frame(glm::normalize(normal)) : glm::dvec3(0, 0, 1);
        if (corners[k].uv) triangle[k].uv = mesh.uvs[*corners[k].uv];
    }
    return triangle;
}

}  // namespace

Surface read_object_text(std::string_view text, const std::string& name, double size) {
    const ObjMesh mesh = read_obj_mesh(text, name);
    Surface surface;
    std::size_t first = 0;
    for (const std::size_t end : mesh.ends) {
        const std::span corners(mesh.corners.data() + first, end - first);
        first = end;
        std::vector<glm::dvec3> places;
        for (const ObjMesh::Corner& corner : corners) places.push_back(mesh.positions[corner.position]);
        const std::vector<std::uint32_t> cut = cut_ears(places).triangles;
        for (std::size_t i = 0; i + 2 < cut.size(); i += 3) {
            surface.triangles.push_back(
                triangle_of(mesh, {corners[cut[i]], corners[cut[i + 1]], corners[cut[i + 2]]}, size));
        }
    }
    if (surface.triangles.empty()) throw UserError(fmt::format("{}: there is no face in this file", name));
    return surface;
}

Surface read_object(const std::filesystem::path& path, double size) {
    return read_object_text(read_text(path), path.string(), size);
}

}  // namespace espalier::geometry
