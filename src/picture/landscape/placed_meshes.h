// Meshes in many places, and what rays see there.
#pragma once

#include "geometry/rays/ray_scene.h"
#include "picture/landscape/ray_mesh.h"

#include <glm/gtc/quaternion.hpp>

namespace espalier::picture {

/// A mesh in one of its places.
struct RayPlace {
    std::uint32_t mesh;  ///< its number
    float scale;
    glm::vec3 position;
    glm::quat rotation;
    bool has_own_light = false;  ///< its colours are as lit
};

/// Where the light comes from; all of it is 1.
struct RayLight {
    glm::vec3 towards_sun;
};

class PlacedMeshes {
public:
    /// The meshes must outlive this.
    explicit PlacedMeshes(std::vector<const RayMesh*> meshes) : meshes_(std::move(meshes)) {}

    /// Puts them into these places alone.
    void place(std::vector<RayPlace> places);

    struct Seen {
        glm::vec3 colour;  ///< 0 to 1
        float distance;
    };
    /// What a ray sees in this light, the direction a vector of length 1; nothing where it meets nothing.
    std::optional<Seen> seen(const glm::vec3& origin, const glm::vec3& direction, const RayLight& light) const;
    bool is_dark(const glm::vec3& point, const glm::vec3& towards_sun) const;

private:
    /// The nearest opaque place behind `from`.
    std::optional<geometry::RayScene::Hit> opaque_hit(const glm::vec3& origin, const glm::vec3& direction,
                                                      float from) const;
    const RayPlace& place_of(const geometry::RayScene::Hit& hit) const { return places_[hit.part][hit.place]; }

    std::vector<const RayMesh*> meshes_;
    std::vector<std::vector<RayPlace>> places_;  ///< of each mesh
    geometry::RayScene rays_;
};

}  // namespace espalier::picture
