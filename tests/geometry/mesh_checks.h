// What holds of closed meshes, whatever they show.
#pragma once

#include "espalier/geometry/plant_geometry.h"

#include <glm/geometric.hpp>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace espalier {

using namespace espalier::geometry;

/// Faces left and right of every edge between places in space: a closed, consistently turned surface has each edge as
/// often in one direction as in the other.
struct EdgeCount {
    std::size_t edges = 0, places = 0;
    bool closed = true;

    explicit EdgeCount(const DrawnMesh& mesh) : EdgeCount(mesh, 0, mesh.pieces.size()) {}
    /// Counts the edges of some of the pieces.
    EdgeCount(const DrawnMesh& mesh, std::size_t first_piece, std::size_t end_piece) {
        std::map<std::array<double, 3>, int> place_of;
        std::map<std::pair<int, int>, int> balance;
        const auto place = [&](std::uint32_t vertex) {
            const glm::dvec3& p = mesh.vertices[vertex].position;
            return place_of.try_emplace({p.x, p.y, p.z}, int(place_of.size())).first->second;
        };
        const std::size_t first = first_piece < end_piece ? mesh.pieces[first_piece].first : 0;
        const std::size_t end =
            first_piece < end_piece ? mesh.pieces[end_piece - 1].first + mesh.pieces[end_piece - 1].count : 0;
        for (std::size_t i = first; i < end; i += 3) {
            for (int k = 0; k < 3; ++k) {
                const int a = place(mesh.triangles[i + k]), b = place(mesh.triangles[i + (k + 1) % 3]);
                if (a == b) continue;
                balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : 1000;
            }
        }
        for (const auto& [edge, count] : balance) closed = closed && count == 1001;
        edges = balance.size();
        places = place_of.size();
    }
};

/// By the divergence theorem; positive if the triangles face outward.
inline double enclosed_volume(const DrawnMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const glm::dvec3 &a = mesh.vertices[mesh.triangles[i]].position,
                         &b = mesh.vertices[mesh.triangles[i + 1]].position,
                         &c = mesh.vertices[mesh.triangles[i + 2]].position;
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

/// The smallest cosine between a triangle's normal and those of its vertices.
inline double worst_normal(const DrawnMesh& mesh) {
    double worst = 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const SurfaceVertex* v[3];
        for (int k = 0; k < 3; ++k) v[k] = &mesh.vertices[mesh.triangles[i + k]];
        const glm::dvec3 normal = glm::cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position);
        if (glm::length(normal) < 1e-12) continue;
        for (const SurfaceVertex* vertex : v) worst = std::min(worst, glm::dot(glm::normalize(normal), vertex->normal));
    }
    return worst;
}

}  // namespace espalier
