#include "picture/landscape/ray_scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

/// Returns the bounds of the place's mesh, turned and moved.
RayBox bounds_of(const RayMesh& mesh, const RayPlace& place) {
    RayBox box;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3& lower = mesh.bounds().lower;
        const glm::vec3& upper = mesh.bounds().upper;
        const glm::vec3 point(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                              corner & 4 ? upper.z : lower.z);
        box.add(place.position + place.rotation * (place.scale * point));
    }
    return box;
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

RayScene::RayScene(std::vector<const RayMesh*> meshes, std::vector<RayPlace> places)
    : meshes_(std::move(meshes)), places_(std::move(places)) {
    std::vector<RayBox> boxes;
    for (const RayPlace& place : places_) boxes.push_back(bounds_of(*meshes_[place.mesh], place));
    tree_.emplace(boxes);
}

// Distances stay what they are: the direction shrinks with the mesh.
Ray RayScene::inside(const RayPlace& place, const Ray& ray) const {
    const glm::quat back = glm::conjugate(place.rotation);
    return {back * (ray.origin - place.position) / place.scale, back * ray.direction / place.scale, ray.nearest,
            ray.furthest};
}

std::optional<RayScene::Seen> RayScene::seen(Ray ray, const RayLight& light) const {
    std::optional<RayMesh::Hit> nearest;
    std::uint32_t nearest_place = 0;
    tree_->visit(ray, [&](std::uint32_t item) {
        Ray local = inside(places_[item], ray);
        if (const auto hit = meshes_[places_[item].mesh]->hit(local)) {
            nearest = hit;
            nearest_place = item;
            ray.furthest = local.furthest;
        }
        return false;
    });
    if (!nearest) return std::nullopt;
    const RayPlace& place = places_[nearest_place];
    RaySurface surface = meshes_[place.mesh]->surface(*nearest);
    if (place.has_own_light) return Seen{surface.colour, ray.furthest};
    surface.normal = place.rotation * surface.normal;
    const glm::vec3 point = ray.origin + ray.furthest * ray.direction;
    const float share = light_of(surface, -ray.direction, light, is_dark(point, light.towards_sun));
    return Seen{glm::min(share * surface.colour, glm::vec3(1)), ray.furthest};
}

bool RayScene::is_dark(const glm::vec3& point, const glm::vec3& towards_sun) const {
    const float size = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), 1.0F});
    Ray ray{point, towards_sun, 1e-5F * size};
    return tree_->visit(
        ray, [&](std::uint32_t item) { return meshes_[places_[item].mesh]->blocks(inside(places_[item], ray)); });
}

std::size_t RayScene::bytes() const {
    return places_.size() * sizeof(RayPlace) + tree_->bytes();
}

}  // namespace espalier::picture
