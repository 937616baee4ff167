#include "study/scan/scanned_plants.h"

#include "archive/meshes/surface_mesh.h"
#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace espalier::study {
namespace {

/// Corners of a ring about an axis.
std::vector<glm::vec3> ring(const glm::vec3& middle, const glm::vec3& axis, float radius, int sides) {
    const glm::vec3 x(geometry::any_across(axis)), y = glm::cross(axis, x);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < sides; ++i) {
        const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
        corners.push_back(middle + radius * (std::cos(turn) * x + std::sin(turn) * y));
    }
    return corners;
}

}  // namespace

ScannedPlants::ScannedPlants(const FrameGeometry& geometry, int sides, std::optional<double> ground) : ground_(ground) {
    const archive::FrameOrgans organs(geometry);
    organs_ = organs.all();
    add_internodes(geometry, organs, sides);
    add_surfaces(geometry, organs);
    if (!corners_.empty()) lowest_ = highest_ = corners_.front();
    for (const glm::vec3& corner : corners_) {
        lowest_ = glm::min(lowest_, corner);
        highest_ = glm::max(highest_, corner);
    }
    const std::array parts{geometry::RayScene::Part{corners_, {glm::mat4x3(1)}}};
    rays_.set_parts(parts);
}

void ScannedPlants::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t organ) {
    if (!(glm::length(glm::cross(b - a, c - a)) > 0)) return;
    corners_.insert(corners_.end(), {a, b, c});
    organ_of_triangle_.push_back(organ);
}

void ScannedPlants::add_internodes(const FrameGeometry& geometry, const archive::FrameOrgans& organs, int sides) {
    const float thinnest = archive::thinnest_radius(geometry);
    for (const FrameInternode& internode : internodes_of(geometry)) {
        const glm::vec3 along = internode.tip - internode.base;
        if (!(glm::length(along) > 0)) continue;
        const std::uint32_t organ = *organs.of_point(internode.tip_point.row());
        const auto radius = [&](float given) { return given > 0 ? given : thinnest; };
        const auto below = ring(internode.base, glm::normalize(along), radius(internode.base_radius), sides);
        const auto above = ring(internode.tip, glm::normalize(along), radius(internode.tip_radius), sides);
        for (std::size_t i = 0; i < below.size(); ++i) {
            const std::size_t next = (i + 1) % below.size();
            add(below[i], below[next], above[i], organ);
            add(above[i], below[next], above[next], organ);
            add(internode.base, below[next], below[i], organ);
            add(internode.tip, above[i], above[next], organ);
        }
    }
}

void ScannedPlants::add_surfaces(const FrameGeometry& geometry, const archive::FrameOrgans& organs) {
    const FrameMesh mesh = archive::surfaces_of(geometry, {});
    std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < organs.all().size(); ++i) {
        const archive::FrameOrgan& organ = organs.all()[i];
        if (organ.is_leaf) numbers.emplace(std::pair(organ.plant, organ.identity), i);
    }
    for (const MeshPart& part : mesh.parts) {
        const auto number = numbers.find({part.plant, part.identity});
        if (number == numbers.end()) continue;
        for (std::size_t i = part.first_triangle; i < part.first_triangle + part.triangles; ++i) {
            const auto& [a, b, c] = mesh.triangles[i];
            add(mesh.points[a], mesh.points[b], mesh.points[c], number->second);
        }
    }
}

std::optional<Touch> ScannedPlants::touch(const glm::vec3& origin, const glm::vec3& direction, float range) const {
    std::optional<Touch> found;
    if (ground_ && direction.y != 0) {
        const float distance = (static_cast<float>(*ground_) - origin.y) / direction.y;
        if (distance > 0 && distance <= range) found = Touch{distance, std::abs(direction.y), std::nullopt};
    }
    const auto hit = rays_.first_hit(origin, direction, 0, found ? found->distance : range);
    if (!hit) return found;
    const glm::vec3* const corner = &corners_[std::size_t{3} * hit->triangle];
    const glm::vec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    return Touch{hit->distance, std::abs(glm::dot(normal, direction)), organ_of_triangle_[hit->triangle]};
}

}  // namespace espalier::study
