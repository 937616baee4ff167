#include "espalier/geometry/free_form.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <map>

namespace espalier::geometry {
namespace {

/// The Bernstein polynomials of a degree at t.
std::vector<double> bernstein(std::size_t degree, double t) {
    std::vector<double> values{1};
    for (std::size_t k = 1; k <= degree; ++k) {
        values.push_back(0);
        for (std::size_t i = k; i > 0; --i) values[i] = (1 - t) * values[i] + t * values[i - 1];
        values[0] *= 1 - t;
    }
    return values;
}

/// A normal, which turns with the surface: by the cofactors of the derivative.
glm::dvec3 turned(const FreeForm& form, const glm::dvec3& point, const glm::dvec3& normal) {
    const double step = 1e-6 * form.scale * glm::length(form.upper - form.lower);
    glm::dmat3 derivative;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 by(0);
        by[axis] = step;
        derivative[axis] = (form.displacement(point + by) - form.displacement(point - by)) / (2 * step);
        derivative[axis][axis] += 1;
    }
    if (std::abs(glm::determinant(derivative)) < 1e-12) return normal;
    const glm::dvec3 result = glm::transpose(glm::inverse(derivative)) * normal;
    const double length = glm::length(result);
    return length > 0 ? result / length : normal;
}

/// What each module's leaf moves by that keeps its shape: the displacement of the first of its points.
class Carrying {
public:
    explicit Carrying(const FreeForm& form) : form_(form) {}

    const glm::dvec3& of(std::uint32_t module, const glm::dvec3& first) {
        const auto [found, is_new] = moves_.try_emplace(module);
        if (is_new) found->second = form_.displacement(first);
        return found->second;
    }

private:
    const FreeForm& form_;
    std::map<std::uint32_t, glm::dvec3> moves_;
};

void carry_polygons(const FreeForm& form, PlantGeometry& geometry, const DrawnSoFar& since) {
    Carrying carrying(form);
    for (std::size_t k = since.polygons; k < geometry.polygons.size(); ++k) {
        const Polygon& polygon = geometry.polygons[k];
        const glm::dvec3 move = carrying.of(polygon.module, geometry.vertices[polygon.first]);
        for (std::uint32_t i = 0; i < polygon.count; ++i) geometry.vertices[polygon.first + i] += move;
    }
}

void deform_mesh(const FreeForm& form, DrawnMesh& mesh, const DrawnSoFar& since) {
    using enum FreeForm::Leaves;
    Carrying carrying(form);
    std::vector<bool> done(mesh.vertices.size() - since.mesh_vertices);
    for (std::size_t k = since.pieces; k < mesh.pieces.size(); ++k) {
        const MeshPiece& piece = mesh.pieces[k];
        const bool is_leaf = piece.kind == MeshPiece::Kind::patch;
        for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i) {
            const std::uint32_t index = mesh.triangles[i];
            if (index < since.mesh_vertices || done[index - since.mesh_vertices]) continue;
            done[index - since.mesh_vertices] = true;
            SurfaceVertex& vertex = mesh.vertices[index];
            if (is_leaf && form.leaves == carried) {
                vertex.position += carrying.of(piece.module, vertex.position);
            } else if (!is_leaf || form.leaves == bent) {
                vertex.normal = turned(form, vertex.position, vertex.normal);
                vertex.position += form.displacement(vertex.position);
            }
        }
    }
}

}  // namespace

glm::dvec3 FreeForm::displacement(const glm::dvec3& point) const {
    const glm::dmat3 axes(-pose.left, pose.heading, -pose.up);
    const glm::dvec3 inside = (point - pose.position) * axes / scale;
    const glm::dvec3 part = glm::clamp((inside - lower) / (upper - lower), 0.0, 1.0);
    const std::vector<double> x = bernstein(counts[0] - 1, part.x), y = bernstein(counts[1] - 1, part.y),
                              z = bernstein(counts[2] - 1, part.z);
    glm::dvec3 sum(0);
    std::size_t at = 0;
    for (const double wz : z) {
        for (const double wy : y) {
            for (const double wx : x) sum += wx * wy * wz * moves[at++];
        }
    }
    return axes * sum * scale;
}

DrawnSoFar DrawnSoFar::of(const PlantGeometry& geometry) {
    return {geometry.polygons.size(),      geometry.vertices.size(),    geometry.organs.size(),
            geometry.mesh.vertices.size(), geometry.mesh.pieces.size(), geometry.labels.size()};
}

void deform(const FreeForm& form, std::span<Internode> internodes, PlantGeometry& geometry, const DrawnSoFar& since) {
    const auto move = [&](glm::dvec3& point) { point += form.displacement(point); };
    for (Internode& internode : internodes) {
        move(internode.base);
        move(internode.tip);
    }
    deform_mesh(form, geometry.mesh, since);
    for (std::size_t k = since.labels; k < geometry.labels.size(); ++k) move(geometry.labels[k].position);
    if (form.leaves == FreeForm::Leaves::left) return;
    for (std::size_t k = since.organs; k < geometry.organs.size(); ++k) move(geometry.organs[k].pose.position);
    if (form.leaves == FreeForm::Leaves::carried) return carry_polygons(form, geometry, since);
    for (std::size_t k = since.vertices; k < geometry.vertices.size(); ++k) move(geometry.vertices[k]);
}

}  // namespace espalier::geometry
