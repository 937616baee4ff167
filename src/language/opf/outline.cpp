#include "language/opf/outline.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

namespace espalier::language::opf {
namespace {

bool is_flat(const MeasuredMesh& mesh) {
    constexpr double rounding = 1e-6;
    glm::dvec3 normal(0), lower = mesh.points[0], upper = lower;
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        const glm::dvec3& corner = mesh.points[face[0]];
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            normal += glm::cross(mesh.points[face[i]] - corner, mesh.points[face[i + 1]] - corner);
        }
    }
    for (const glm::dvec3& point : mesh.points) lower = glm::min(lower, point), upper = glm::max(upper, point);
    const double size = glm::length(upper - lower), length = glm::length(normal);
    return length > 0 && std::all_of(mesh.points.begin(), mesh.points.end(), [&](const glm::dvec3& point) {
               return std::abs(glm::dot(normal, point - mesh.points[0])) <= rounding * size * length;
           });
}

}  // namespace

std::optional<std::vector<std::uint32_t>> outline_of(const MeasuredMesh& mesh) {
    if (mesh.faces.empty() || !is_flat(mesh)) return std::nullopt;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second) return std::nullopt;
        }
    }
    std::unordered_map<std::uint32_t, std::uint32_t> next;  // along the border
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from}) && !next.emplace(from, to).second) return std::nullopt;
    }
    if (next.empty()) return std::nullopt;
    std::vector<std::uint32_t> outline{mesh.faces[0][0]};
    if (!next.contains(outline[0])) outline[0] = std::min_element(next.begin(), next.end())->first;
    while (outline.size() <= next.size()) {
        const auto further = next.find(outline.back());
        if (further == next.end()) return std::nullopt;
        if (further->second == outline[0]) break;
        outline.push_back(further->second);
    }
    return outline.size() == next.size() ? std::optional(outline) : std::nullopt;
}

}  // namespace espalier::language::opf
