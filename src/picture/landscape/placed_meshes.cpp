#include "picture/landscape/placed_meshes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::picture {
namespace {

glm::mat4x3 matrix_of(const RayPlace& place) {
    const glm::mat3 turn = place.scale * glm::mat3_cast(place.rotation);
    return {turn[0], turn[1], turn[2], place.position};
}

/// The share of the light that a surface sends to the eye.
float light_of(const RaySurface& surface, const glm::vec3& to_eye, const RayLight& light, bool is_dark) {
    constexpr float sky = 0.36F, sky_above = 0.14F, sun = 0.72F, through = 0.7F;
    const glm::vec3 normal = glm::dot(surface.normal, to_eye) < 0 ? -surface.normal : surface.normal;
    const float facing = glm::dot(normal, light.towards_sun);
    const float above = surface.is_thin ? std::abs(normal.y) : normal.y;
    const float ambient = sky + sky_above * above;
    if (is_dark) return ambient;
    if (facing >= 0) return ambient + sun * facing;
    return ambient + (surface.is_thin ? sun * through * -facing : 0);
}

}  // namespace

void PlacedMeshes::place(std::vector<RayPlace> places) {
    places_.assign(meshes_.size(), {});
    for (RayPlace& place : places) places_[place.mesh].push_back(place);
    std::vector<std::vector<glm::vec3>> corners;
    std::vector<geometry::RayScene::Part> parts;
    for (const RayMesh* mesh : meshes_) corners.push_back(mesh->corners());
    for (std::size_t k = 0; k < meshes_.size(); ++k) {
        geometry::RayScene::Part& part = parts.emplace_back();
        part.corners = corners[k];
        for (const RayPlace& place : places_[k]) part.places.push_back(matrix_of(place));
    }
    rays_.set_parts(parts);
}

std::optional<geometry::RayScene::Hit> PlacedMeshes::opaque_hit(const glm::vec3& origin, const glm::vec3& direction,
                                                                float from) const {
    constexpr float furthest = std::numeric_limits<float>::max();
    for (;;) {
        const auto hit = rays_.first_hit(origin, direction, from, furthest);
        if (!hit || meshes_[hit->part]->is_opaque(*hit)) return hit;
        from = std::nextafter(hit->distance, furthest);
    }
}

std::optional<PlacedMeshes::Seen> PlacedMeshes::seen(const glm::vec3& origin, const glm::vec3& direction,
                                                     const RayLight& light) const {
    const auto hit = opaque_hit(origin, direction, 0);
    if (!hit) return std::nullopt;
    const RayPlace& place = place_of(*hit);
    RaySurface surface = meshes_[place.mesh]->surface(*hit);
    if (place.has_own_light) return Seen{surface.colour, hit->distance};
    surface.normal = place.rotation * surface.normal;
    const glm::vec3 point = origin + hit->distance * direction;
    const float share = light_of(surface, -direction, light, is_dark(point, light.towards_sun));
    return Seen{glm::min(share * surface.colour, glm::vec3(1)), hit->distance};
}

bool PlacedMeshes::is_dark(const glm::vec3& point, const glm::vec3& towards_sun) const {
    const float size = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), 1.0F});
    return opaque_hit(point, towards_sun, 1e-5F * size).has_value();
}

}  // namespace espalier::picture
