// Triangles that rays meet, with their colours and textures.
#pragma once

#include "archive/meshes/surface_mesh.h"
#include "base/png_file.h"
#include "geometry/rays/ray_scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace espalier::picture {

/// The picture of a texture file; null if there is none.
using TextureOf = std::function<std::shared_ptr<const OpacityPicture>(const std::string& file)>;

struct RaySurface {
    glm::vec3 normal;  ///< a vector of length 1
    glm::vec3 colour;  ///< 0 to 1
    bool is_thin;      ///< light goes through
};

class RayMesh {
public:
    RayMesh(const FrameMesh& mesh, const TextureOf& texture_of);

    using Hit = geometry::RayScene::Hit;

    /// Three a triangle.
    std::vector<glm::vec3> corners() const;
    /// Every other ray goes on through what is half transparent, as chance decides for its place.
    bool is_opaque(const Hit& hit) const;
    RaySurface surface(const Hit& hit) const;

    /// With what rays need beside it.
    std::size_t bytes() const;

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;
        std::uint16_t material;
        bool is_thin;
    };
    struct Look {
        glm::vec3 colour;
        std::shared_ptr<const OpacityPicture> texture;
    };

    const OpacityPicture::Pixel& texel(const Triangle& triangle, float u, float v) const;

    std::vector<glm::vec3> points_, normals_;
    std::vector<glm::vec2> uvs_;  ///< empty where nothing wears a texture
    std::vector<Triangle> triangles_;
    std::vector<Look> looks_;
};

}  // namespace espalier::picture
