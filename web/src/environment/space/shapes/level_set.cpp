// Pages ask the triangles themselves: the level set of a machine is OpenVDB's. The distance is exact here, so it
// differs from that of a machine by a fraction of a voxel.
#include "environment/space/shapes/level_set.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace espalier::environment {
namespace {

constexpr double band_beside = 3;  // voxels on either side, as on a machine

/// Normals that tell inside from outside wherever the nearest point lies: those of edges and corners are the means of
/// their triangles', weighted with the angles at a corner (Baerentzen & Aanaes 2005).
class Normals {
public:
    explicit Normals(const TriangleMesh& mesh) : mesh_(mesh), of_corners_(mesh.points.size(), glm::dvec3(0)) {
        for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
            const glm::dvec3 normal = mesh.normal(triangle);
            for (int k = 0; k < 3; ++k) {
                const auto [a, b, c] = corners(triangle, k);
                of_corners_[a] += angle(a, b, c) * normal;
                of_edges_[edge(a, b)] += normal;
            }
        }
    }

    /// At a point of a triangle.
    glm::dvec3 at(const glm::dvec3& point, std::uint32_t triangle) const {
        constexpr double on_it = 1e-9;
        const double size = glm::length(mesh_.bounds().upper - mesh_.bounds().lower);
        for (int k = 0; k < 3; ++k) {
            const auto [a, b, c] = corners(triangle, k);
            if (glm::length(point - mesh_.points[a]) <= on_it * size) return of_corners_[a];
        }
        for (int k = 0; k < 3; ++k) {
            const auto [a, b, c] = corners(triangle, k);
            const glm::dvec3 along = glm::normalize(mesh_.points[b] - mesh_.points[a]);
            if (glm::length(glm::cross(point - mesh_.points[a], along)) <= on_it * size) {
                return of_edges_.at(edge(a, b));
            }
        }
        return mesh_.normal(triangle);
    }

private:
    std::array<std::uint32_t, 3> corners(std::size_t triangle, int first) const {
        const auto& all = mesh_.triangles[triangle];
        const auto from = static_cast<std::size_t>(first);
        return {all[from], all[(from + 1) % 3], all[(from + 2) % 3]};
    }
    static std::pair<std::uint32_t, std::uint32_t> edge(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }
    double angle(std::uint32_t at, std::uint32_t b, std::uint32_t c) const {
        const glm::dvec3 u = mesh_.points[b] - mesh_.points[at], v = mesh_.points[c] - mesh_.points[at];
        return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
    }

    const TriangleMesh& mesh_;
    std::vector<glm::dvec3> of_corners_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> of_edges_;
};

}  // namespace

struct LevelSet::Storage {
    Storage(const TriangleMesh& mesh, double edge) : tree(mesh), normals(tree.mesh()), voxel(edge) {}

    TriangleTree tree;
    Normals normals;
    double voxel;
};

LevelSet::LevelSet(const TriangleMesh& mesh, double voxel, const std::string&, const Place&)
    : storage_(std::make_unique<const Storage>(mesh, voxel)) {}

LevelSet::LevelSet(LevelSet&&) noexcept = default;
LevelSet::~LevelSet() = default;

LevelSet::Reading LevelSet::read(const glm::dvec3& point) const {
    const TriangleTree::Nearest nearest = storage_->tree.nearest(point);
    const glm::dvec3 away = point - nearest.point;
    const double length = glm::length(away);
    const glm::dvec3 normal = storage_->normals.at(nearest.point, nearest.triangle);
    const double sign = glm::dot(away, normal) < 0 ? -1 : 1;
    const glm::dvec3 gradient = length > 0 ? sign * away / length : normal;
    return {length < band_beside * storage_->voxel, sign * length, gradient};
}

}  // namespace espalier::environment
