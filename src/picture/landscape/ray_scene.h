// Meshes in many places, and what rays meet there.
#pragma once

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

class RayScene {
public:
    /// The meshes must outlive the scene.
    RayScene(std::vector<const RayMesh*> meshes, std::vector<RayPlace> places);

    struct Seen {
        glm::vec3 colour;  ///< 0 to 1
        float distance;
    };
    /// What a ray sees in this light; nothing where it meets nothing.
    std::optional<Seen> seen(Ray ray, const RayLight& light) const;
    bool is_dark(const glm::vec3& point, const glm::vec3& towards_sun) const;

    std::size_t bytes() const;

private:
    Ray inside(const RayPlace& place, const Ray& ray) const;

    std::vector<const RayMesh*> meshes_;
    std::vector<RayPlace> places_;
    std::optional<BoxTree> tree_;
};

}  // namespace espalier::picture
